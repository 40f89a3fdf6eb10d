//! `hairline-rt cases`: what a device says about test vectors, for `hairline verify`.

mod table;

use crate::device::Device;
use crate::failure::Failure;
use crate::input::read_text;
use crate::output::{print, write_json};
use crate::structure::{Build, Part, build};
use crate::trace::{DeviceRay, Found, Tracer};
use hairline_record::group_digits;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt;
use std::fs;
use std::path::Path;
use table::{Demand, VectorTest, read};

/// The device's answers to test vectors, as JSON for `hairline verify --profile vulkan` (or dxr)
///
/// Each test has a structure of its own; a group of triangles has one, and its hits are counted by the candidates of a ray query.
/// Tests in f64, and rays that no GPU may be asked about (a t_min below 0, NaN, infinite coordinates, no direction), are "not asked".
#[derive(clap::Args)]
pub struct Arguments {
    /// vectors/core.csv, or what `hairline vectors -n N --format csv` wrote
    vectors: String,
    /// The file of results
    #[arg(short, long)]
    output: String,
}

/// How many structures are built at once.
const BATCH: usize = 1024;

/// A file of results.
#[derive(Serialize)]
struct Results<'a> {
    vectors: String,
    product: String,
    results: BTreeMap<&'a str, Value>,
}

/// Answers to the tests of a topic that differ from what every reading of them demands.
#[derive(Clone, Copy, Default)]
struct Count {
    asked: u64,
    false_misses: u64,
    false_hits: u64,
    /// Groups of triangles that are hit twice where once is right. Specifications say that this "should" not be.
    twice: u64,
    /// Hits whose t is NaN or infinite.
    not_a_number: u64,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let text = read_text(&arguments.vectors)?;
    let tests = read(&arguments.vectors, &text)?;
    let device = Device::open()?;
    let tracer = Tracer::new(&device);

    let (asked, not_asked): (Vec<&VectorTest>, _) =
        tests.iter().partition(|test| test.is_for_a_gpu());
    let mut results = BTreeMap::new();
    for test in &not_asked {
        results.insert(test.id, json!("not asked"));
    }
    let mut counts: BTreeMap<&str, Count> = BTreeMap::new();
    for tests in asked.chunks(BATCH) {
        let parts: Vec<Part> = tests
            .iter()
            .map(|test| Part::of(test.triangles.clone()))
            .collect();
        let scenes: Vec<&[Part]> = parts.chunks(1).collect();
        let rays: Vec<DeviceRay> = tests.iter().map(|test| test.ray).collect();
        let mut encoder = device.gpu.create_command_encoder(&Default::default());
        let structures = build(&device, &mut encoder, &scenes, Build::FastTrace)?;
        let found = tracer.trace_each(encoder, &structures, &rays)?;
        for (test, found) in tests.iter().zip(&found) {
            results.insert(test.id, answer(test, found));
            counts.entry(test.topic()).or_default().add(test, found);
        }
    }

    let results = Results {
        vectors: digest_beside(&arguments.vectors),
        product: device.name(),
        results,
    };
    write_json(&arguments.output, &results)?;
    print(&Counts {
        device: &device,
        by_topic: counts,
        not_asked: not_asked.len() as u64,
    })
}

/// An answer as `hairline verify` reads it.
fn answer(test: &VectorTest, found: &Found) -> Value {
    // JSON has no number for these.
    let number = |x: f32| match x.is_finite() {
        true => json!(x),
        false => json!(x.to_string()),
    };
    match (test.is_group, found.face()) {
        (true, _) => json!(found.count),
        (false, None) => json!("miss"),
        (false, Some(_)) => {
            json!({"hit": true, "t": number(found.t), "u": number(found.u), "v": number(found.v)})
        }
    }
}

impl Count {
    fn add(&mut self, test: &VectorTest, found: &Found) {
        self.asked += 1;
        let is_hit = found.face().is_some();
        match test.demand {
            Demand::Hit if !is_hit => self.false_misses += 1,
            Demand::Miss if is_hit => self.false_hits += 1,
            Demand::ExactlyOne | Demand::AtLeastOne if found.count == 0 => self.false_misses += 1,
            Demand::ExactlyOne if found.count > 1 => self.twice += 1,
            _ if is_hit && !found.t.is_finite() => self.not_a_number += 1,
            _ => {}
        }
    }

    fn wrong(&self) -> [u64; 4] {
        [
            self.false_misses,
            self.false_hits,
            self.twice,
            self.not_a_number,
        ]
    }

    fn add_all(&mut self, other: &Count) {
        self.asked += other.asked;
        self.false_misses += other.false_misses;
        self.false_hits += other.false_hits;
        self.twice += other.twice;
        self.not_a_number += other.not_a_number;
    }

    fn fmt(&self, f: &mut fmt::Formatter<'_>, topic: &str) -> fmt::Result {
        let [misses, hits, twice, not_a_number] = self.wrong().map(group_digits);
        let asked = group_digits(self.asked);
        writeln!(
            f,
            "{topic:30} {asked:>8} {misses:>13} {hits:>11} {twice:>10} {not_a_number:>12}"
        )
    }
}

/// The screen.
struct Counts<'a> {
    device: &'a Device,
    by_topic: BTreeMap<&'a str, Count>,
    not_asked: u64,
}

impl fmt::Display for Counts<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.device.name())?;
        writeln!(f)?;
        writeln!(
            f,
            "{:30} {:>8} {:>13} {:>11} {:>10} {:>12}",
            "", "tests", "false misses", "false hits", "hit twice", "t no number"
        )?;
        let mut sum = Count::default();
        let mut right = 0;
        for (topic, count) in &self.by_topic {
            match count.wrong() == [0; 4] {
                true => right += 1,
                false => count.fmt(f, topic)?,
            }
            sum.add_all(count);
        }
        sum.fmt(f, "all")?;
        writeln!(f)?;
        writeln!(
            f,
            "None of {right} other kinds of tests has any of these. {} tests were not asked: their numbers are f64, or no ray of a GPU.",
            group_digits(self.not_asked)
        )?;
        writeln!(
            f,
            "Counted is what every reading of a test demands. By a specification: hairline verify RESULTS --profile vulkan (or dxr)"
        )
    }
}

/// The digest of the vectors, which stands in a file beside the core set; other sets have none.
fn digest_beside(path: &str) -> String {
    let beside = Path::new(path).with_file_name("sha256.txt");
    let text = fs::read_to_string(beside).unwrap_or_default();
    text.split_whitespace()
        .next()
        .unwrap_or_default()
        .to_owned()
}
