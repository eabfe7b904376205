//! From a request to what answers it.

use std::net::SocketAddr;
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::task::{Context, Poll};

use axum::body::{Body, Bytes, to_bytes};
use axum::extract::{FromRequest, Multipart, Request, State};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HOST, ORIGIN, REFERRER_POLICY,
    X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderMap, HeaderName, Method, StatusCode};
use axum::response::{IntoResponse, Response};
use futures_core::Stream;
use serde::de::DeserializeOwned;
use serde_json::json;
use tokio::sync::mpsc;

use super::frame::frame;
use super::guard::{Said, Token, let_in};
use super::refused::Refused;
use super::session::Session;
use super::stage::ViewRequest;
use super::{about, cell, command, page, save, section, suite, verify, view};

/// The header of the page's own requests.
const MARK: HeaderName = HeaderName::from_static("x-topple");
const SITE: HeaderName = HeaderName::from_static("sec-fetch-site");
/// Bytes of a request without files at most.
const LARGEST: usize = 1 << 20;
/// Frames that wait for a page at most.
const WAITING: usize = 2;

/// What every request is answered from.
pub struct Shared {
    /// The word in the page's address.
    pub token: Token,
    /// Where the server listens.
    pub at: SocketAddr,
    /// What it has.
    pub session: Arc<Session>,
}

/// Ends work when the one who asked for it is gone.
struct Asker(Arc<AtomicBool>);

impl Drop for Asker {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Frames on their way to a page.
struct Frames {
    receive: mpsc::Receiver<Vec<u8>>,
    /// A page that goes ends the work.
    _asker: Asker,
}

impl Stream for Frames {
    type Item = Result<Bytes, std::convert::Infallible>;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context) -> Poll<Option<Self::Item>> {
        self.receive.poll_recv(context).map(|frame| frame.map(|bytes| Ok(Bytes::from(bytes))))
    }
}

/// A header that stands once at most; `Some(None)` where it is not there, none where it stands twice or is no text.
fn only(headers: &HeaderMap, name: HeaderName) -> Option<Option<&str>> {
    let mut all = headers.get_all(name).iter();
    match (all.next(), all.next()) {
        (None, _) => Some(None),
        (Some(value), None) => value.to_str().ok().map(Some),
        _ => None,
    }
}

/// The path below the token of a request that is let in.
fn allowed(shared: &Shared, request: &Request) -> Option<String> {
    let headers = request.headers();
    let said = Said {
        path: request.uri().path(),
        host: only(headers, HOST)?,
        origin: only(headers, ORIGIN)?,
        site: only(headers, SITE)?,
        posts: !matches!(*request.method(), Method::GET | Method::HEAD),
        marked: headers.contains_key(MARK),
    };
    let_in(&shared.token, shared.at, &said).map(String::from)
}

/// Answers a request.
pub async fn answer(State(shared): State<Arc<Shared>>, request: Request) -> Response {
    let path = allowed(&shared, &request);
    let mut response = match path {
        None => (StatusCode::FORBIDDEN, "not allowed\n").into_response(),
        Some(path) => inner(&shared, &path, request).await,
    };
    for (name, value) in [
        (CONTENT_SECURITY_POLICY, page::POLICY),
        (REFERRER_POLICY, "no-referrer"),
        (X_CONTENT_TYPE_OPTIONS, "nosniff"),
        // The page belongs to this binary, and goes with it.
        (CACHE_CONTROL, "no-store"),
    ] {
        if let Ok(value) = value.parse() {
            response.headers_mut().insert(name, value);
        }
    }
    response
}

/// Answers a request that is let in.
async fn inner(shared: &Arc<Shared>, path: &str, request: Request) -> Response {
    let session = Arc::clone(&shared.session);
    match (request.method(), path) {
        (&Method::GET | &Method::HEAD, "about") => {
            run(move |_| Ok(about::about(&session).to_string())).await.unwrap_or_else(refused)
        }
        (&Method::GET | &Method::HEAD, path) => {
            let path = if path.is_empty() { page::INDEX } else { path };
            match page::file(path) {
                Some(file) => ([(CONTENT_TYPE, file.kind)], file.bytes).into_response(),
                None => (StatusCode::NOT_FOUND, "there is no such file\n").into_response(),
            }
        }
        (&Method::POST, "record" | "suite") => {
            let suite = path == "suite";
            dropped(session, suite, request).await.unwrap_or_else(refused)
        }
        (&Method::POST, _) => posted(session, path, request).await.unwrap_or_else(refused),
        _ => (StatusCode::METHOD_NOT_ALLOWED, "give GET or POST\n").into_response(),
    }
}

/// Answers a request with a body in JSON.
async fn posted(session: Arc<Session>, path: &str, request: Request) -> Result<Response, Refused> {
    let body = to_bytes(request.into_body(), LARGEST).await;
    let body = body.map_err(|error| Refused::told(format!("no request: {error}")))?;
    match path {
        "map" => Ok(map(session, read(&body)?)),
        "cell" => {
            let asked = read(&body)?;
            run(move |stop| Ok(cell::run(&session, &asked, stop)?.to_string())).await
        }
        "section" => {
            let asked = read(&body)?;
            run(move |stop| Ok(section::run(&session, &asked, stop)?.to_string())).await
        }
        "verify" => {
            let asked = read(&body)?;
            run(move |stop| Ok(verify::run(&session, &asked, stop)?.to_string())).await
        }
        "command" => {
            let asked = read(&body)?;
            run(move |_| Ok(command::run(&session, &asked)?.to_string())).await
        }
        "save" => {
            let asked = read(&body)?;
            let (bytes, kind) = work(move |stop| save::run(&session, &asked, stop)).await?;
            Ok(([(CONTENT_TYPE, kind)], bytes).into_response())
        }
        _ => Ok((StatusCode::NOT_FOUND, "there is no such request\n").into_response()),
    }
}

/// Reads a request.
fn read<T: DeserializeOwned>(body: &Bytes) -> Result<T, Refused> {
    serde_json::from_slice(body).map_err(|error| Refused::told(format!("no request: {error}")))
}

/// Does work on a thread of its own; it is ended where the page goes.
async fn work<T: Send + 'static>(
    act: impl FnOnce(&AtomicBool) -> Result<T, Refused> + Send + 'static,
) -> Result<T, Refused> {
    let stop = Arc::new(AtomicBool::new(false));
    let asker = Asker(Arc::clone(&stop));
    let done = tokio::task::spawn_blocking(move || act(&stop)).await;
    drop(asker);
    done.map_err(|_| Refused::told("the computation broke off: a mistake in topple"))?
}

/// The same for an answer in JSON.
async fn run(
    act: impl FnOnce(&AtomicBool) -> Result<String, Refused> + Send + 'static,
) -> Result<Response, Refused> {
    let text = work(act).await?;
    Ok(([(CONTENT_TYPE, "application/json")], text).into_response())
}

/// An error as the page reads it.
fn refused(error: Refused) -> Response {
    let text = serde_json::to_string(&error).unwrap_or_default();
    (StatusCode::BAD_REQUEST, [(CONTENT_TYPE, "application/json")], text).into_response()
}

/// Computes a view; its frames are sent as they are made.
fn map(session: Arc<Session>, asked: ViewRequest) -> Response {
    let (send, receive) = mpsc::channel(WAITING);
    let Some(stop) = session.begin(&asked.tab, asked.view) else {
        // A newer view has begun: nobody waits for this one.
        return Body::empty().into_response();
    };
    let frames = Frames { receive, _asker: Asker(Arc::clone(&stop)) };
    tokio::task::spawn_blocking(move || {
        let take = |frame| send.blocking_send(frame).is_ok();
        let ran = match &asked.suite {
            Some(id) => suite::run(&session, &asked, id, &stop, take),
            None => view::run(&session, &asked, &stop, take),
        };
        session.end(&asked.tab, asked.view);
        if let Err(error) = ran
            && !error.cancelled
        {
            // A page that is gone reads no error.
            let _ = send.blocking_send(frame(json!({ "error": error }), &[]));
        }
    });
    ([(CONTENT_TYPE, "application/octet-stream")], Body::from_stream(frames)).into_response()
}

/// Takes files that were dropped on the page.
async fn dropped(
    session: Arc<Session>,
    suite: bool,
    request: Request,
) -> Result<Response, Refused> {
    let unread = |error: String| Refused::told(format!("the files did not arrive: {error}"));
    let mut parts =
        Multipart::from_request(request, &()).await.map_err(|error| unread(error.body_text()))?;
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    while let Some(part) = parts.next_field().await.map_err(|error| unread(error.body_text()))? {
        let name = part.file_name().unwrap_or("record").to_string();
        let bytes = part.bytes().await.map_err(|error| unread(error.body_text()))?;
        files.push((name, bytes.to_vec()));
    }
    if files.is_empty() {
        return Err(Refused::told("no file arrived; drop a record's file"));
    }
    run(move |_| {
        let records = &session.records;
        if suite {
            return Ok(session.suites.add(records.folder(), &files)?.to_string());
        }
        let told = files.iter().map(|(name, bytes)| records.told(&records.add(name, bytes)?));
        let told = told.collect::<Result<Vec<_>, Refused>>()?;
        let mut first = told[0].clone();
        first["files"] = told.into();
        Ok(first.to_string())
    })
    .await
}
