//! Disjoint sets (union-find).

/// Disjoint sets of the numbers below a bound. The least member represents its set, whatever the order of joining.
pub(crate) struct Forest {
    parent: Vec<u32>,
}

impl Forest {
    /// Every number by itself.
    pub(crate) fn new(size: u32) -> Self {
        Self { parent: (0..size).collect() }
    }

    /// The least member of the set that contains `of`.
    pub(crate) fn root(&mut self, mut of: u32) -> u32 {
        while self.parent[of as usize] != of {
            // Halving the path keeps later walks short.
            let above = self.parent[self.parent[of as usize] as usize];
            self.parent[of as usize] = above;
            of = above;
        }
        of
    }

    /// Makes one set of two.
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// The number of sets.
    pub(crate) fn count(&self) -> usize {
        (0..).zip(&self.parent).filter(|(number, parent)| number == *parent).count()
    }
}

#[cfg(test)]
mod tests {
    use super::Forest;

    #[test]
    fn joins_and_counts() {
        let mut forest = Forest::new(6);
        forest.join(5, 3);
        forest.join(4, 5);
        forest.join(0, 1);
        assert_eq!((forest.root(4), forest.root(1), forest.root(2)), (3, 0, 2));
        assert_eq!(forest.count(), 3);
    }
}
