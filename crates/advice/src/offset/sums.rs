//! The counts for each scheme; sums that come out the same however they are split.

use crate::audit::{Histogram, Trials};
use crate::engine::Merge;

/// Lengths, in bins of one part in 256.
pub type Lengths = Histogram<8>;

/// How high some starts lie over the plane, in one unit; those on the plane or behind it apart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heights {
    /// The heights of the starts on the right side.
    pub above: Lengths,
    /// How deep the others lie.
    pub behind: Lengths,
}

impl Heights {
    /// Counts a start.
    pub fn add(&mut self, height: f64, is_right: bool) {
        if is_right {
            self.above.add(height)
        } else {
            self.behind.add(height)
        }
    }

    /// The height below which a share of all starts lies; none if that is on the plane or behind it.
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let (above, behind) = (self.above.count(), self.behind.count());
        let rank = (share * (above + behind) as f64).ceil() - behind as f64;
        (0.0 < rank).then(|| self.above.quantile(rank / above as f64))
    }

    fn merge(&mut self, other: &Heights) {
        self.above.merge(&other.above);
        self.behind.merge(&other.behind);
    }
}

/// The results of one scheme at the hit points of one kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OfScheme {
    /// How many new rays.
    pub rays: u64,
    /// Starts on the plane, behind it, or nowhere.
    pub wrong: u64,
    /// Wrong starts that are not finite.
    pub not_finite: u64,
    /// The lowest index with a wrong start.
    pub first_wrong: Option<u64>,
    /// New rays that hit the triangle which they leave, says the kernel.
    pub self_hits: u64,
    /// New rays with a wrong start, a self-hit or both.
    pub failed: u64,
    /// Starts that lie beyond a wall in front of the triangle.
    pub beyond_wall: u64,
    /// Starts behind the neighbour that is folded up at the edge nearest to the hit point.
    pub past_neighbour: u64,
    /// In longest edges of the triangle.
    pub in_edges: Heights,
    /// In ulps of the largest coordinate of the triangle.
    pub in_ulps: Heights,
    /// The way along the normal, over the least that is right, where the hit point itself is not.
    pub over_least: Lengths,
}

impl OfScheme {
    /// So many of all new rays.
    pub fn trials(&self, count: u64) -> Trials {
        Trials::independent(count, self.rays)
    }

    fn merge(&mut self, other: &OfScheme) {
        self.rays += other.rays;
        self.wrong += other.wrong;
        self.not_finite += other.not_finite;
        self.first_wrong = self.first_wrong.into_iter().chain(other.first_wrong).min();
        self.self_hits += other.self_hits;
        self.failed += other.failed;
        self.beyond_wall += other.beyond_wall;
        self.past_neighbour += other.past_neighbour;
        self.in_edges.merge(&other.in_edges);
        self.in_ulps.merge(&other.in_ulps);
        self.over_least.merge(&other.over_least);
    }
}

/// All that a run counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OffsetSums {
    /// Hit points.
    pub hits: u64,
    /// First rays on which the kernel reported no hit.
    pub missed: u64,
    /// Hits of a triangle without area, or along its plane.
    pub without_side: u64,
    /// Hits whose point is not finite.
    pub not_finite: u64,
    /// The least weight of a vertex at any hit point; 0 if none is below.
    pub least_weight: f64,
    /// Hit points for which no distance along the normal is right.
    pub without_least: u64,
    /// The smallest safe distances along the normal, where one is needed.
    pub least: Lengths,
    /// The same in ulps of the hit point's largest coordinate.
    pub least_in_ulps: Lengths,
    /// By scheme.
    pub schemes: Vec<OfScheme>,
}

impl Merge for OffsetSums {
    fn merge(&mut self, other: OffsetSums) {
        self.hits += other.hits;
        self.missed += other.missed;
        self.without_side += other.without_side;
        self.not_finite += other.not_finite;
        self.least_weight = self.least_weight.min(other.least_weight);
        self.without_least += other.without_least;
        self.least.merge(&other.least);
        self.least_in_ulps.merge(&other.least_in_ulps);
        self.schemes
            .iter_mut()
            .zip(&other.schemes)
            .for_each(|(sum, more)| sum.merge(more));
    }
}
