//! Files that are dropped on the page: records, or a suite of them.

use axum::extract::{FromRequest, Multipart, Request};

use super::refused::Refused;
use super::session::Session;
use super::suites::{File, is_of_a_suite};

/// The files of a request: names with contents.
///
/// # Errors
/// That none arrived, or not whole.
pub async fn files(request: Request) -> Result<Vec<File>, Refused> {
    let unread = |error: String| Refused::told(format!("the files did not arrive: {error}"));
    let mut parts =
        Multipart::from_request(request, &()).await.map_err(|error| unread(error.body_text()))?;
    let mut files: Vec<File> = Vec::new();
    while let Some(part) = parts.next_field().await.map_err(|error| unread(error.body_text()))? {
        let name = part.file_name().unwrap_or("record").to_string();
        let bytes = part.bytes().await.map_err(|error| unread(error.body_text()))?;
        files.push((name, bytes));
    }
    if files.is_empty() {
        return Err(Refused::told("no file arrived; drop a record's file"));
    }
    Ok(files)
}

/// Keeps files as a suite; what it is, in JSON.
///
/// # Errors
/// Those of a suite's files, and of the disk.
pub fn suite(session: &Session, files: &[File]) -> Result<String, Refused> {
    let records = &session.records;
    Ok(session.suites.add((&records.folder()?, &records.room), files)?.to_string())
}

/// Keeps files as records; what the first one is, and each of them, in JSON. Where a zip or a list of records is among them they
/// are a suite, by whatever name.
///
/// # Errors
/// Those of a record's file, of a suite's, and of the disk.
pub fn records(session: &Session, files: &[File]) -> Result<String, Refused> {
    if files.iter().any(|(_, bytes)| is_of_a_suite(bytes)) {
        return suite(session, files);
    }
    let records = &session.records;
    let told = files.iter().map(|(name, bytes)| records.told(&records.add(name, bytes)?));
    let told = told.collect::<Result<Vec<_>, Refused>>()?;
    let mut first = told[0].clone();
    first["files"] = told.into();
    Ok(first.to_string())
}
