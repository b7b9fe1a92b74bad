//! Every connection is an open file, and a process may usually open 1024.

/// Files beside the connections: jobs, results, and what is read in passing.
const OTHERS: u64 = 1024;

/// Asks the system for as many files as the connections may need, and warns where it gives fewer: then accepting stops for
/// a while whenever they are used up.
pub(super) fn ask_for(connections: usize) {
    let wanted = u64::try_from(connections).unwrap_or(u64::MAX).saturating_add(OTHERS);
    match rlimit::increase_nofile_limit(wanted) {
        Ok(allowed) if allowed >= wanted => {}
        Ok(allowed) => tracing::warn!(
            allowed,
            wanted,
            "this process may open fewer files than --max-connections and jobs need: raise its limit (ulimit -n), or \
             lower --max-connections"
        ),
        Err(error) => tracing::warn!(%error, "how many files this process may open is not known"),
    }
}
