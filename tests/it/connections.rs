//! A service on a socket: its clients, its limits and its shutdown.

mod connection_limit;
mod half_closed;
mod http2;
mod invalid_heads;
mod shutdown;
mod slow_clients;
mod tls;

use std::future::Future;
use std::net::SocketAddr;
use std::time::Duration;

use tokio::io::{AsyncRead, AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::oneshot;
use tokio::task::JoinHandle;
use verne_service::serve_on;

use crate::http::settings;

const QUESTION: &str = "GET /livez HTTP/1.1\r\nHost: localhost\r\n\r\n";

/// A service on a socket of its own.
struct Served {
    address: SocketAddr,
    stop: oneshot::Sender<()>,
    ended: JoinHandle<()>,
}

async fn serve(flags: &str) -> Served {
    let config = settings(&format!("--memory-only {flags}"));
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    let (stop, told) = oneshot::channel::<()>();
    let told = async { drop(told.await) };
    let ended = tokio::spawn(async move { serve_on(vec![listener], &config, told).await.unwrap() });
    Served { address, stop, ended }
}

impl Served {
    async fn connect(&self) -> TcpStream {
        TcpStream::connect(self.address).await.unwrap()
    }

    /// Tells it to stop, and waits until it has.
    async fn end(self) {
        drop(self.stop);
        in_time(self.ended).await.unwrap();
    }
}

/// Waits for a future, but fails after a limit instead of hanging.
async fn in_time<T>(future: impl Future<Output = T>) -> T {
    tokio::time::timeout(Duration::from_mins(1), future).await.expect("it comes to an end")
}

/// Everything until the connection is closed, by whatever means.
async fn rest(stream: &mut (impl AsyncRead + Unpin)) -> String {
    let mut bytes = Vec::new();
    // A reset is an end too.
    let _ = in_time(stream.read_to_end(&mut bytes)).await;
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Asks whether the service lives, on a connection that stays open; false if it is closed instead.
async fn asked(stream: &mut TcpStream) -> bool {
    if stream.write_all(QUESTION.as_bytes()).await.is_err() {
        return false;
    }
    let mut answer = Vec::new();
    while !answer.ends_with(b"{\"status\":\"ok\"}") {
        match in_time(stream.read_buf(&mut answer)).await {
            Ok(0) | Err(_) => return false,
            Ok(_) => {}
        }
    }
    answer.starts_with(b"HTTP/1.1 200 OK\r\n")
}

#[tokio::test]
async fn bytes_that_are_not_http_do_not_affect_other_clients() {
    let served = serve("").await;
    for garbage in [
        b"\0\0\0\0\xff\xff\xff\xff".as_slice(),
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
        b"GET\r\n\r\n",
        b"GET / HTTP/9.9\r\n\r\n",
        b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\nthis is no frame of any kind",
        b"POST /fk HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n{}",
        b"POST /fk HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nZZ\r\n",
    ] {
        let mut stream = served.connect().await;
        stream.write_all(garbage).await.unwrap();
        let answer = rest(&mut stream).await;
        assert!(!answer.contains(" 200 "), "{answer}");
    }
    assert!(asked(&mut served.connect().await).await);
    served.end().await;
}
