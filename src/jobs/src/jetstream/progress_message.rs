//! The message that a worker sends when a job progresses. Its subject names the job.

/// Encodes the generation of a job and its progress, from 0 to 1.
pub(super) fn encode(generation: u64, progress: f64) -> Vec<u8> {
    [generation.to_be_bytes(), progress.to_be_bytes()].concat()
}

pub(super) fn decode(payload: &[u8]) -> Option<(u64, f64)> {
    let (generation, progress) = payload.split_first_chunk::<8>()?;
    Some((u64::from_be_bytes(*generation), f64::from_be_bytes(*progress.first_chunk()?)))
}
