//! Where segments to a hit point end: the far end of a shadow ray, for `offset` and `epsilon`.

use super::elsewhere::{self, ComparedRates};
use super::page::{Block, Cell, Head, Row, Table, Use};
use crate::advised::Advised;
use crate::arith::{ScalarName, two_digits};
use crate::case::{Scene, ShortNumber};
use crate::engine::Observer;
use hairline_advice::offset::{SegmentEnd, SegmentPlan, SegmentSums};
use hairline_record::{NamedRate, Rate};
use hairline_record::{group_digits, percent};

/// Shares that are shown besides the ones that are made for the scene: from the scalar's own precision on, ten times as
/// large each.
const SHARES: i32 = 4;

/// Ends are this many times as far from the target as any segment of the pilots needs.
const ROOM: f64 = 2.0;

/// Segments from a point to a hit point of a kernel in a scalar, and where they end.
#[apply(part!)]
pub struct SegmentsPart {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// How many segments, on planes of the first kind.
    pub segments: u64,
    /// The results of each end.
    pub ends: Vec<SegmentEndPart>,
}

/// The results of one end of segments.
#[apply(part!)]
pub struct SegmentEndPart {
    /// t_max for a direction that goes as far as the target p; and p, if it is moved. n is the unit normal on the side of
    /// the start.
    pub end: String,
    /// True if it was made for the scene.
    pub is_made: bool,
    /// Segments that the surface at their target blocks.
    pub blocked: Rate,
    /// By how much segments are shorter than their way to the target: the median.
    pub shorter_median: f64,
    /// 99 % are shorter by at most this.
    pub shorter_p99: f64,
    /// The results on the other kinds of planes.
    pub elsewhere: Vec<SegmentKindPart>,
}

/// The results of one end on planes of one kind.
#[apply(part!)]
pub struct SegmentKindPart {
    /// The name of the kind of planes and rays.
    pub plane: String,
    /// Segments that the surface at their target blocks.
    pub blocked: Rate,
}

impl SegmentsPart {
    /// Makes ends for what is seen on pilots in each scene, the first of which the table is about, and counts them on the
    /// segments that are reported.
    pub fn study<F: Advised>(
        plan: &SegmentPlan<'_>,
        scenes: &[Scene],
        [pilot_seed, seed]: [u64; 2],
        observer: &dyn Observer,
    ) -> SegmentsPart {
        let run = |ends: &[SegmentEnd], seed: u64| -> Vec<SegmentSums> {
            let in_scene = |scene| SegmentPlan {
                scene,
                ends,
                seed,
                ..*plan
            };
            scenes
                .iter()
                .map(|scene| F::segments(&in_scene(scene), observer))
                .collect()
        };
        let pilots = run(&[], pilot_seed);
        let mut ends = usual::<F>();
        let made = made_for(&pilots);
        ends.extend(&made);
        let runs = run(&ends, seed);
        let of_end = |(place, end): (usize, &SegmentEnd)| SegmentEndPart {
            end: words(*end),
            is_made: made.contains(end),
            blocked: Rate::new(runs[0].trials(place), true),
            shorter_median: runs[0].shorter[place].quantile(0.5),
            shorter_p99: runs[0].shorter[place].quantile(0.99),
            elsewhere: scenes[1..]
                .iter()
                .zip(&runs[1..])
                .map(|(scene, sums)| SegmentKindPart {
                    plane: scene.kind().to_string(),
                    blocked: Rate::new(sums.trials(place), true),
                })
                .collect(),
        };
        SegmentsPart {
            kernel: plan.row.entry.info.name.to_owned(),
            set: plan.row.set.clone(),
            scalar: F::NAME,
            segments: runs[0].segments,
            ends: ends.iter().enumerate().map(of_end).collect(),
        }
    }
}

/// The target itself, and shares that programs use.
fn usual<F: Advised>() -> Vec<SegmentEnd> {
    let precision = F::EPSILON.to_f64().log10().floor() as i32;
    let shares = (0..SHARES).map(|i| 10f64.powi(precision + i));
    [0.0]
        .into_iter()
        .chain(shares)
        .map(SegmentEnd::Share)
        .collect()
}

/// The ends that no pilot needs earlier, on any kind of plane: a share, a length and a lift, as far as t shows them.
fn made_for(pilots: &[SegmentSums]) -> Vec<SegmentEnd> {
    let largest = |of: fn(&SegmentSums) -> f64| pilots.iter().map(of).fold(0.0, f64::max);
    let with_room = |needed: f64| two_digits(ROOM * needed, true);
    let share = largest(|pilot| pilot.largest_share);
    if share == 0.0 {
        return Vec::new();
    }
    let mut ends = vec![
        SegmentEnd::Lift(with_room(largest(|pilot| pilot.largest_lift))),
        SegmentEnd::Length(with_room(largest(|pilot| pilot.largest_length))),
    ];
    // Of 1 or more nothing would be left of the segment.
    let share = with_room(share);
    ends.extend((share < 1.0).then_some(SegmentEnd::Share(share)));
    ends
}

/// An end as code has it.
fn words(end: SegmentEnd) -> String {
    match end {
        SegmentEnd::Share(0.0) => "1".to_owned(),
        SegmentEnd::Share(share) => format!("1 - {}", ShortNumber(share)),
        SegmentEnd::Length(length) => format!("1 - {}/|d|", ShortNumber(length)),
        SegmentEnd::Lift(height) => format!("1, p + n*{}", ShortNumber(height)),
    }
}

impl SegmentsPart {
    /// The answer, and the ends that argue for it.
    pub fn blocks(&self, kinds: &[String], unit: &str) -> Vec<Block> {
        let title = format!("{} {}, segments that end at p", self.kernel, self.scalar);
        let mut blocks = vec![Block::Heading(title)];
        blocks.extend(self.answer(kinds, unit));
        let row = |end: &SegmentEndPart| {
            let blocked = end.blocked.rate.map_or("-".to_owned(), percent);
            let length = |length: f64| Cell::number(length, short_length(length));
            let cells = [
                Cell::rate(&end.blocked, blocked),
                length(end.shorter_median),
                length(end.shorter_p99),
            ];
            Row::new(&end.end, cells)
        };
        let heads = vec![
            Head::text("t_max"),
            Head::of("blocked"),
            Head::of("shorter by: median"),
            Head::of("99 %"),
        ];
        blocks.push(Block::Table(Table::new(
            heads,
            self.ends.iter().map(row).collect(),
        )));
        let compared = self.ends.iter().map(|end| ComparedRates {
            label: end.end.clone(),
            rates: std::iter::once(&end.blocked)
                .chain(end.elsewhere.iter().map(|other| &other.blocked))
                .cloned()
                .collect(),
        });
        let compared: Vec<ComparedRates> = compared.collect();
        blocks.extend(elsewhere::blocks(
            "more blocked",
            kinds,
            &compared,
            |rate| rate.rate.map_or("-".to_owned(), percent),
        ));
        blocks
    }

    /// True if the kernel hit surfaces at p, and its t shows where segments must end.
    fn shows_ends(&self) -> bool {
        self.ends.iter().any(|end| end.is_made)
    }

    /// The ends that block no segment, the one that leaves out least first.
    fn safe(&self) -> Vec<&SegmentEndPart> {
        let mut safe: Vec<&SegmentEndPart> =
            self.ends.iter().filter(|end| end.never_blocks()).collect();
        safe.sort_by(|a, b| a.shorter_median.total_cmp(&b.shorter_median));
        safe
    }

    /// The end to use, and the others that are as safe.
    fn answer(&self, kinds: &[String], unit: &str) -> Vec<Block> {
        if !self.shows_ends() {
            return vec![Block::text(
                "No end is advised: the kernel reports no t, or hits no surface at p.",
            )];
        }
        let safe = self.safe();
        let segments = group_digits(self.segments);
        let Some((best, others)) = safe.split_first() else {
            return vec![Block::text(format!(
                "Every end here lets the surface at p block some of the {segments} segments: end them earlier."
            ))];
        };
        let others: Vec<&str> = others.iter().map(|end| end.end.as_str()).collect();
        let kinds = if kinds.len() < 2 {
            ""
        } else {
            ", nor with any other kind of plane or ray"
        };
        let mut notes = vec![format!(
            "the surface at p blocks none of {segments} segments{kinds}; half of them end {}{unit} too early, or less",
            short_length(best.shorter_median)
        )];
        if !others.is_empty() {
            notes.push(format!(
                "as safe, but shorter: t_max = {}",
                others.join("; t_max = ")
            ));
        }
        vec![Block::Use(Use {
            lead: "use".to_owned(),
            parts: vec![format!("t_max = {}", best.end)],
            notes,
        })]
    }
}

impl SegmentsPart {
    /// How often segments are blocked.
    pub fn counted(&self) -> Vec<NamedRate> {
        let SegmentsPart {
            kernel,
            set,
            scalar,
            ..
        } = self;
        let of_end = |end: &SegmentEndPart| NamedRate {
            what: format!(
                "{kernel} ({set}) {scalar} segments, t_max = {}: blocked",
                end.end
            ),
            rate: end.blocked.clone(),
            command: None,
        };
        self.ends.iter().map(of_end).collect()
    }
}

/// A length in three digits at most.
pub fn short_length(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        x if !x.is_finite() => "inf".to_owned(),
        1e5.. => format!("{x:.0e}"),
        100.0.. => format!("{x:.0}"),
        10.0.. => format!("{x:.1}"),
        1.0.. => format!("{x:.2}"),
        0.01.. => format!("{x:.3}"),
        _ => format!("{x:.1e}"),
    }
}

impl SegmentsPart {
    /// The best end in one line, as beside the epsilons of a kernel; none if nothing shows where segments must end.
    pub fn sentence(&self) -> Option<String> {
        if !self.shows_ends() {
            return None;
        }
        let at_target = self
            .ends
            .first()
            .and_then(|end| end.blocked.rate)
            .map_or("-".to_owned(), percent);
        let safe = self.safe();
        let end = match safe.first() {
            Some(best) => format!("end at t_max = {}", best.end),
            None => "end before p (`hairline offset`)".to_owned(),
        };
        Some(format!(
            "Shadow rays to a point p of a surface: {end} (at t_max = 1 the surface blocks {at_target} of them)."
        ))
    }
}

impl SegmentEndPart {
    /// True if no segment was blocked, on any kind of plane.
    fn never_blocks(&self) -> bool {
        let all = std::iter::once(&self.blocked).chain(self.elsewhere.iter().map(|on| &on.blocked));
        all.into_iter().all(|blocked| blocked.count == 0)
    }
}
