//! From a request to what answers it.

use std::convert::Infallible;
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use hyper::header::{
    ALLOW, CACHE_CONTROL, CONTENT_SECURITY_POLICY, HOST, ORIGIN, REFERRER_POLICY,
    X_CONTENT_TYPE_OPTIONS,
};
use hyper::header::{HeaderMap, HeaderName, HeaderValue};
use hyper::{Method, StatusCode};
use serde_json::json;
use tokio::sync::mpsc;

use super::answers::{Asker, Frames, Request, Response, bytes, of_frames, plain, whole};
use super::body::read;
use super::frame::frame;
use super::guard::{Credentials, Refusal, Token, let_in};
use super::refused::Refused;
use super::session::Session;
use super::stage::ViewRequest;
use super::{about, cell, command, dropped, page, save, section, suite, verify, view};

/// The header of the page's own requests.
const MARK: HeaderName = HeaderName::from_static("x-topple");
/// What it says in an answer: a request that is refused. A browser would tell any status of an error in its console, as if the page
/// were broken.
const REFUSED: &str = "refused";
const JSON: &str = "application/json";
const SITE: HeaderName = HeaderName::from_static("sec-fetch-site");
/// Bytes of a request without files at most.
const LARGEST: usize = 1 << 20;
/// Frames that wait for a page at most.
const WAITING: usize = 2;

/// Paths that are asked by POST.
const POSTED: [&str; 8] =
    ["map", "cell", "section", "verify", "command", "save", "record", "suite"];

/// What every request is answered from.
pub struct Shared {
    /// The word in the page's address.
    pub token: Token,
    /// Where the server listens.
    pub at: SocketAddr,
    /// What it has.
    pub session: Arc<Session>,
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
fn allowed(shared: &Shared, request: &Request) -> Result<String, Refusal> {
    let headers = request.headers();
    let said = Credentials {
        path: request.uri().path(),
        host: only(headers, HOST).ok_or(Refusal::Host)?,
        origin: only(headers, ORIGIN).ok_or(Refusal::Page)?,
        site: only(headers, SITE).ok_or(Refusal::Page)?,
        posts: !matches!(*request.method(), Method::GET | Method::HEAD | Method::OPTIONS),
        marked: headers.contains_key(MARK),
    };
    let_in(&shared.token, &said).map(String::from)
}

/// Answers a request.
///
/// # Errors
/// None: a refusal is an answer, too.
pub async fn answer(shared: Arc<Shared>, request: Request) -> Result<Response, Infallible> {
    let path = allowed(&shared, &request);
    let mut response = match path {
        Err(refusal) => plain(StatusCode::FORBIDDEN, refusal.line(shared.at.port())),
        Ok(path) => inner(&shared, &path, request).await,
    };
    for (name, value) in [
        (CONTENT_SECURITY_POLICY, page::POLICY),
        (REFERRER_POLICY, "no-referrer"),
        (X_CONTENT_TYPE_OPTIONS, "nosniff"),
        // The page belongs to this binary, and goes with it.
        (CACHE_CONTROL, "no-store"),
    ] {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    Ok(response)
}

/// Answers a request that is let in.
async fn inner(shared: &Arc<Shared>, path: &str, request: Request) -> Response {
    let session = Arc::clone(&shared.session);
    match (request.method(), path) {
        (&Method::GET | &Method::HEAD, "about") => {
            run(move |_| Ok(about::about(&session).to_string())).await.unwrap_or_else(refused)
        }
        (&Method::POST, path) if POSTED.contains(&path) => {
            posted(session, path, request).await.unwrap_or_else(refused)
        }
        (method, path) => match page::served(path) {
            Some((kind, contents)) if matches!(*method, Method::GET | Method::HEAD) => {
                bytes(kind, contents)
            }
            Some(_) => only_by("GET, HEAD"),
            None if path == "about" => only_by("GET, HEAD"),
            None if POSTED.contains(&path) => only_by("POST"),
            None => plain(StatusCode::NOT_FOUND, "there is no such file or request\n"),
        },
    }
}

/// What a path is asked by, to a request by another method.
fn only_by(methods: &'static str) -> Response {
    let line = format!("ask by {}\n", methods.replace(", ", " or "));
    let mut response = plain(StatusCode::METHOD_NOT_ALLOWED, line);
    response.headers_mut().insert(ALLOW, HeaderValue::from_static(methods));
    response
}

/// Answers a request that has a body: files, or JSON.
async fn posted(session: Arc<Session>, path: &str, request: Request) -> Result<Response, Refused> {
    if matches!(path, "record" | "suite") {
        let act = if path == "suite" { dropped::suite } else { dropped::records };
        let files = dropped::files(request).await?;
        return run(move |_| act(&session, &files)).await;
    }
    let body = whole(request, LARGEST).await.ok_or_else(|| {
        Refused::told(format!("the request did not arrive whole; send {LARGEST} bytes at most"))
    })?;
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
            let (contents, kind) = work(move |stop| save::run(&session, &asked, stop)).await?;
            Ok(bytes(kind, contents))
        }
        _ => Ok(plain(StatusCode::NOT_FOUND, "there is no such request\n")),
    }
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
    Ok(bytes(JSON, text))
}

/// An error as the page reads it.
fn refused(error: Refused) -> Response {
    let text = serde_json::to_string(&error).unwrap_or_default();
    let mut response = bytes(JSON, text);
    response.headers_mut().insert(MARK, HeaderValue::from_static(REFUSED));
    response
}

/// Computes a view; its frames are sent as they are made.
fn map(session: Arc<Session>, asked: ViewRequest) -> Response {
    let (send, receive) = mpsc::channel(WAITING);
    let Some(stop) = session.begin(&asked.tab, asked.view) else {
        // A newer view has begun: nobody waits for this one.
        return plain(StatusCode::OK, "");
    };
    let frames = Frames::new(receive, Asker(Arc::clone(&stop)));
    tokio::task::spawn_blocking(move || {
        let take = |frame| send.blocking_send(frame).is_ok();
        // A word that finds no room is followed by a newer one.
        let tell = |frame| drop(send.try_send(frame));
        let ran = match &asked.suite {
            Some(id) => suite::run(&session, &asked, id, &stop, take, &tell),
            None => view::run(&session, &asked, &stop, take, &tell),
        };
        session.end(&asked.tab, asked.view);
        if let Err(error) = ran
            && !error.cancelled
        {
            // A page that is gone reads no error.
            let _ = send.blocking_send(frame(json!({ "error": error }), &[]));
        }
    });
    of_frames(frames)
}
