//! The signals of the operating system.

/// Returns when the process receives SIGTERM or ctrl-c.
pub(crate) async fn stop_signal() {
    let interrupted = async {
        // Without a handler the signal ends the process, which is the system's default.
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    };
    tokio::select! {
        () = interrupted => {}
        () = terminated() => {}
    }
    tracing::info!("stopping: the service finishes its requests and returns its jobs to the queue");
}

#[cfg(unix)]
async fn terminated() {
    use tokio::signal::unix::{SignalKind, signal};
    match signal(SignalKind::terminate()) {
        Ok(mut signals) => drop(signals.recv().await),
        Err(_) => std::future::pending().await,
    }
}

#[cfg(not(unix))]
async fn terminated() {
    std::future::pending().await
}

/// Prevents SIGHUP, which reloads the keys, from ending the process. The future never ends; it logs each SIGHUP if the
/// process has no keys.
#[cfg(unix)]
pub(crate) fn handle_hangups(has_keys: bool) -> impl Future<Output = ()> {
    use tokio::signal::unix::{SignalKind, signal};
    let hangups = signal(SignalKind::hangup());
    async move {
        if let Ok(mut hangups) = hangups {
            while hangups.recv().await.is_some() {
                if !has_keys {
                    tracing::info!("SIGHUP: without --keys there is nothing to reload");
                }
            }
        }
        std::future::pending::<()>().await;
    }
}

/// This system has no SIGHUP.
#[cfg(not(unix))]
pub(crate) fn handle_hangups(_has_keys: bool) -> impl Future<Output = ()> {
    std::future::pending()
}
