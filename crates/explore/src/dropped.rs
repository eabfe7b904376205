//! Files that are dropped on the page: records, or a suite of them.

use hyper::body::Bytes;
use topple::scene::bounded;

use super::answers::{Request, whole};
use super::refused::Refused;
use super::session::Session;
use super::suites::{File, is_of_a_suite};

/// Bytes of a request: a suite's files at most.
const LARGEST: usize = 512 << 20;

/// The files of a request: names with contents.
///
/// # Errors
/// That none arrived, or not whole.
pub async fn files(request: Request) -> Result<Vec<File>, Refused> {
    let unread = || {
        let most = bounded::size(LARGEST as u64);
        Refused::told(format!("the files did not arrive whole; drop {most} at most at a time"))
    };
    let body = whole(request, LARGEST).await.ok_or_else(unread)?;
    match parts(body) {
        None => Err(unread()),
        Some(files) if files.is_empty() => {
            Err(Refused::told("no file arrived; drop a record's file"))
        }
        Some(files) => Ok(files),
    }
}

/// The files of a body: as in a frame, a header in JSON behind its length, here the name and the length of each file; then their
/// bytes, one file after another. None of another body.
fn parts(mut body: Bytes) -> Option<Vec<File>> {
    let mut take = |count: usize| (count <= body.len()).then(|| body.split_to(count));
    let length = u32::from_le_bytes(take(4)?[..].try_into().ok()?);
    let header: Vec<(String, usize)> = serde_json::from_slice(&take(length as usize)?).ok()?;
    let files: Option<Vec<File>> =
        header.into_iter().map(|(name, length)| Some((name, take(length)?))).collect();
    files.filter(|_| body.is_empty())
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

#[cfg(test)]
mod tests {
    use super::parts;

    #[test]
    fn files_are_those_of_the_header_and_of_a_whole_body_alone() {
        let body = |header: &str, bytes: &str| {
            let length = (header.len() as u32).to_le_bytes();
            [&length[..], header.as_bytes(), bytes.as_bytes()].concat()
        };
        let header = r#"[["a \"b\".txt",2],["empty",0],["c",3]]"#;
        let files = parts(body(header, "12345").into()).unwrap();
        let names: Vec<&str> = files.iter().map(|(name, _)| &**name).collect();
        assert_eq!(names, ["a \"b\".txt", "empty", "c"]);
        assert_eq!(
            files.iter().map(|(_, bytes)| &bytes[..]).collect::<Vec<_>>(),
            [&b"12"[..], b"", b"345"]
        );
        assert!(parts(body("[]", "").into()).unwrap().is_empty());
        let far = format!(r#"[["a",{}]]"#, u64::MAX);
        for wrong in [
            body(header, "1234"),
            body(header, "123456"),
            body("{}", ""),
            body(&far, "1"),
            vec![9, 0, 0, 0],
            vec![1],
        ] {
            assert!(parts(wrong.clone().into()).is_none(), "{wrong:?}");
        }
    }
}
