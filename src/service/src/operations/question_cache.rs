//! Typed questions of recent jobs and results. A process that has asked a question does not read it from text again.

use std::sync::Arc;

use moka::sync::Cache;
use verne_jobs::JobId;

use crate::operations::question::Question;
use crate::wire::error::OperationError;
use crate::wire::result_id::ResultId;

/// Most workspaces and maps in the cache: a question weighs as many as it has.
const CAPACITY: u64 = 4000;

/// The questions that were asked or read last, by the ids of their answers. Its clones share one cache.
#[derive(Clone)]
pub(crate) struct QuestionCache(Cache<JobId, Arc<Question>>);

impl QuestionCache {
    /// An empty cache.
    pub(crate) fn new() -> Self {
        let weight = |_: &JobId, question: &Arc<Question>| match &**question {
            Question::Family(family) => family.count().saturating_add(1),
            _ => 1,
        };
        Self(Cache::builder().max_capacity(CAPACITY).weigher(weight).build())
    }

    /// Adds a question.
    pub(crate) fn insert(&self, question: Arc<Question>) {
        self.0.insert(question.id().job(), question);
    }

    /// The question with this id: from the cache, or from its text.
    pub(crate) fn get_or_read(&self, id: ResultId, text: &[u8]) -> Result<Arc<Question>, OperationError> {
        if let Some(question) = self.0.get(&id.job()) {
            return Ok(question);
        }
        let question = Arc::new(Question::from_text(text, id)?);
        self.insert(Arc::clone(&question));
        Ok(question)
    }
}
