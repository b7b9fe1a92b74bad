//! Signals that a process is sent.

/// Returns when the process is to end: SIGTERM or ctrl-c.
pub(crate) async fn told_to_stop() {
    let interrupted = async {
        // Without a handler the default remains: the signal ends the process.
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

/// From now on SIGHUP, at which files of keys are read again, does not end the process. As long as this is polled, one that
/// finds nothing to read is told of.
#[cfg(unix)]
pub(crate) fn outlive_hangups(has_keys: bool) -> impl Future<Output = ()> {
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

/// There is no SIGHUP here.
#[cfg(not(unix))]
pub(crate) fn outlive_hangups(_has_keys: bool) -> impl Future<Output = ()> {
    std::future::pending()
}
