//! The message that a worker sends when a job progresses.

/// Progress of one generation of a job. The subject names the job.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProgressMessage {
    pub(super) generation: u64,
    /// From 0 to 1.
    pub(super) fraction: f64,
}

impl ProgressMessage {
    pub(super) fn encode(self) -> Vec<u8> {
        [self.generation.to_be_bytes(), self.fraction.to_be_bytes()].concat()
    }

    pub(super) fn decode(payload: &[u8]) -> Option<Self> {
        let (generation, fraction) = payload.split_first_chunk::<8>()?;
        let generation = u64::from_be_bytes(*generation);
        Some(Self { generation, fraction: f64::from_be_bytes(*fraction.first_chunk()?) })
    }
}
