//! What the server takes and gives: requests read whole, answers of bytes or of frames.

use std::convert::Infallible;
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::task::{Context, Poll};

use http_body_util::{BodyExt, Either, Full, Limited};
use hyper::StatusCode;
use hyper::body::{Body, Bytes, Frame, Incoming};
use hyper::header::{CONTENT_TYPE, HeaderValue};
use tokio::sync::mpsc;

/// A request, whose body has not arrived yet.
pub type Request = hyper::Request<Incoming>;

/// An answer.
pub type Response = hyper::Response<Either<Full<Bytes>, Frames>>;

/// Ends work when the one who asked for it is gone.
pub struct Asker(pub Arc<AtomicBool>);

impl Drop for Asker {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Frames on their way to a page; a page that goes ends the work.
pub struct Frames {
    receive: mpsc::Receiver<Vec<u8>>,
    _asker: Asker,
}

impl Frames {
    /// Those that arrive.
    pub fn new(receive: mpsc::Receiver<Vec<u8>>, asker: Asker) -> Frames {
        Frames { receive, _asker: asker }
    }
}

impl Body for Frames {
    type Data = Bytes;
    type Error = Infallible;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context,
    ) -> Poll<Option<Result<Frame<Bytes>, Infallible>>> {
        let frame = self.receive.poll_recv(context);
        frame.map(|frame| frame.map(|bytes| Ok(Frame::data(bytes.into()))))
    }
}

/// The body of a request; none where it is larger than `most` bytes or breaks off.
pub async fn whole(request: Request, most: usize) -> Option<Bytes> {
    let body = Limited::new(request.into_body(), most).collect().await;
    body.ok().map(|body| body.to_bytes())
}

fn of_kind(kind: &'static str, body: Either<Full<Bytes>, Frames>) -> Response {
    let mut response = Response::new(body);
    response.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static(kind));
    response
}

/// A line of text for people.
pub fn plain(status: StatusCode, line: impl Into<Bytes>) -> Response {
    let mut response = bytes("text/plain; charset=utf-8", line);
    *response.status_mut() = status;
    response
}

/// Bytes of a kind.
pub fn bytes(kind: &'static str, contents: impl Into<Bytes>) -> Response {
    of_kind(kind, Either::Left(Full::new(contents.into())))
}

/// Frames, each as it is made.
pub fn of_frames(frames: Frames) -> Response {
    of_kind("application/octet-stream", Either::Right(frames))
}
