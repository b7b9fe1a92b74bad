//! Disjoint sets of numbers (union-find).

/// Disjoint sets of the numbers below a bound. The least member represents its set, whatever the order of unions.
pub(crate) struct UnionFind {
    parent: Vec<u32>,
}

impl UnionFind {
    /// Sets of one number each.
    pub(crate) fn new(size: u32) -> Self {
        Self { parent: (0..size).collect() }
    }

    /// The least member of the set that contains `member`.
    pub(crate) fn find(&mut self, mut member: u32) -> u32 {
        while self.parent[member as usize] != member {
            // Halving the path keeps later walks short.
            let grandparent = self.parent[self.parent[member as usize] as usize];
            self.parent[member as usize] = grandparent;
            member = grandparent;
        }
        member
    }

    /// Unites the sets of two numbers.
    pub(crate) fn union(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// The number of sets.
    pub(crate) fn count(&self) -> usize {
        (0..).zip(&self.parent).filter(|(number, parent)| number == *parent).count()
    }
}

#[cfg(test)]
mod tests {
    use super::UnionFind;

    #[test]
    fn unions_are_counted_and_represented_by_their_least_member() {
        let mut sets = UnionFind::new(6);
        sets.union(5, 3);
        sets.union(4, 5);
        sets.union(0, 1);
        assert_eq!((sets.find(4), sets.find(1), sets.find(2)), (3, 0, 2));
        assert_eq!(sets.count(), 3);
    }
}
