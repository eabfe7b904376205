//! The server: on this machine only, at a port that the system chooses, below a token.

use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use axum::Router;

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
    ///
    /// # Errors
    /// Those of the system.
    pub fn serve(self, session: Session, ended: impl Fn() -> bool) -> Result<(), ServeError> {
        let session = Arc::new(session);
        let Server { listener, at, token } = self;
        let shared = Arc::new(Shared { token, at, session: Arc::clone(&session) });
        let router = Router::new().fallback(answer).with_state(shared);
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .enable_io()
            .enable_time()
            .build()?;
        let served = runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(listener)?;
            let served = tokio::spawn(async move { axum::serve(listener, router).await });
            let told = ending::listen()?;
            while !ended() && !told.load(Ordering::Relaxed) && !served.is_finished() {
                tokio::time::sleep(ASKED).await;
            }
            match served.is_finished() {
                true => served.await.unwrap_or_else(|error| Err(std::io::Error::other(error))),
                false => {
                    served.abort();
                    Ok(())
                }
            }
        });
        session.stop();
        runtime.shutdown_timeout(LAST);
        session.records.forget();
        Ok(served?)
    }
}
