//! The server: on this machine only, at a port that the system chooses, below a token.

use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};

use super::ending;
use super::guard::{NoToken, Token};
use super::routes::{Shared, answer};
use super::session::Session;

/// Why a page is not served.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// No random numbers.
    #[error(transparent)]
    Token(#[from] NoToken),
    /// The port is taken, or not for this user.
    #[error("port {port}: {reason}; give another port, or none")]
    Port {
        /// Which one; 0: any.
        port: u16,
        /// What the system says.
        reason: std::io::Error,
    },
    /// The system gives no threads or no sockets.
    #[error("the page cannot be served: {0}")]
    Serve(#[from] std::io::Error),
}

/// A server that listens.
pub struct Server {
    listener: TcpListener,
    at: SocketAddr,
    token: Token,
}

/// How often it is asked whether the server is to end.
const ASKED: Duration = Duration::from_millis(50);
/// Time for what still runs when the server ends.
const LAST: Duration = Duration::from_millis(500);

impl Server {
    /// Listens at a port of the loopback; 0: any that is free.
    ///
    /// # Errors
    /// A port that is taken; those of the system.
    pub fn bind(port: u16) -> Result<Server, ServeError> {
        let bound = TcpListener::bind((Ipv4Addr::LOCALHOST, port));
        let listener = bound.map_err(|reason| ServeError::Port { port, reason })?;
        listener.set_nonblocking(true)?;
        Ok(Server { at: listener.local_addr()?, listener, token: Token::new()? })
    }

    /// The page's address.
    pub fn address(&self) -> String {
        format!("http://{}/{}/", self.at, self.token.text())
    }

    /// Serves the page of a session until `ended`, or until the system tells the process to end.
    pub fn serve(self, session: Session, ended: impl Fn() -> bool) -> Result<(), ServeError> {
        let session = Arc::new(session);
        let Server { listener, at, token } = self;
        let shared = Arc::new(Shared { token, at, session: Arc::clone(&session) });
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .enable_io()
            .enable_time()
            .build()?;
        let served = runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(listener)?;
            let accepting = tokio::spawn(accept(listener, shared));
            let told = ending::listen()?;
            while !ended() && !told.load(Ordering::Relaxed) {
                tokio::time::sleep(ASKED).await;
            }
            accepting.abort();
            Ok(())
        });
        session.stop();
        runtime.shutdown_timeout(LAST);
        session.records.forget();
        served
    }
}

/// Answers each connection on a task of its own. A connection that breaks off ends its task alone; where the system has no
/// more sockets, it may have some again later.
async fn accept(listener: tokio::net::TcpListener, shared: Arc<Shared>) {
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            tokio::time::sleep(ASKED).await;
            continue;
        };
        let shared = Arc::clone(&shared);
        let service = service_fn(move |request| answer(Arc::clone(&shared), request));
        // With a timer a header that does not end is given up after half a minute.
        let mut connection = http1::Builder::new();
        connection.timer(TokioTimer::new());
        tokio::spawn(connection.serve_connection(TokioIo::new(stream), service));
    }
}
