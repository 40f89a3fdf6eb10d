//! `hairline explain`: one case, its exact truth, and what each gate of each kernel made of it.

use super::exit::{Failure, Status};
use super::input::{corpus_files, name_of, read_corpus, read_mesh, truth_line};
use super::output::write_result;
use super::select::{KernelArguments, unknown};
use crate::arith::{Exact, Float};
use crate::audit::{Row, exact_severity};
use crate::case::{Case, CaseId};
use crate::contract::Extent;
use crate::corpus::lines::{self, AnyCase, StoredCase};
use crate::family::{FAMILIES, Grouping, Made, MeshFamily, find};
use crate::judge::{GroupTruth, Obligation, group_truth, judge, obligation, promises_direction};
use crate::kernel::{Scalar, Tunable, Verdict};
use crate::oracle;
use crate::truth::Truth;
use clap::Args;
use std::io::{self, Write};

/// Which case, and which kernels.
#[derive(Args)]
pub struct ExplainArguments {
    /// A case id, the name of a stored case, or a case as JSON
    #[arg(value_name = "CASE")]
    case: String,

    #[command(flatten)]
    kernels: KernelArguments,

    /// The mesh that the case's id speaks of
    #[arg(long, value_name = "FILE")]
    mesh: Option<String>,

    /// Where the stored case is: a JSON lines file, or a folder of them
    #[arg(long, value_name = "FILE|DIR")]
    corpus: Option<String>,
}

/// Cases in one of the scalars: one, or the triangles of a group.
enum Cases {
    F32(Vec<Case<f32>>, Grouping),
    F64(Vec<Case<f64>>, Grouping),
}

/// Runs the command.
pub fn run(arguments: &ExplainArguments) -> Result<Status, Failure> {
    let rows = arguments.kernels.rows()?;
    let cases = arguments.cases()?;
    write_result("-", |out| match &cases {
        Cases::F32(cases, grouping) => write_cases(out, &arguments.case, cases, *grouping, &rows),
        Cases::F64(cases, grouping) => write_cases(out, &arguments.case, cases, *grouping, &rows),
    })?;
    Ok(Status::Success)
}

impl ExplainArguments {
    fn cases(&self) -> Result<Cases, Failure> {
        if self.case.trim_start().starts_with('{') {
            let stored = lines::read(self.case.as_bytes(), "argument").next();
            let missing = || Failure::usage("the argument holds no case".to_owned());
            return Ok(stored_cases(stored.ok_or_else(missing)??));
        }
        if let Some(path) = &self.corpus {
            return self.stored(path);
        }
        let id: CaseId = self.case.parse().map_err(|error| {
            Failure::usage(format!("{error}; for the name of a stored case add --corpus FILE"))
        })?;
        match id.scalar.as_str() {
            "f32" => Ok(from_id::<f32>(&id, self.mesh.as_deref()).map(|(c, r)| Cases::F32(c, r))?),
            "f64" => Ok(from_id::<f64>(&id, self.mesh.as_deref()).map(|(c, r)| Cases::F64(c, r))?),
            other => Err(Failure::usage(format!("unknown scalar '{other}' in '{id}'"))),
        }
    }

    fn stored(&self, path: &str) -> Result<Cases, Failure> {
        let mut names = Vec::new();
        for file in corpus_files(path)? {
            for stored in read_corpus(&file)? {
                if name_of(&stored) == self.case {
                    return Ok(stored_cases(stored));
                }
                names.push(name_of(&stored));
            }
        }
        let names = names.iter().map(String::as_str);
        Err(unknown("case", &self.case, names, &format!("hairline truth {path}")))
    }
}

fn stored_cases(stored: StoredCase) -> Cases {
    match stored.case {
        AnyCase::F32(case) => Cases::F32(vec![case], Grouping::Single),
        AnyCase::F64(case) => Cases::F64(vec![case], Grouping::Single),
    }
}

/// The cases of an id, and how they belong together.
fn from_id<F: Scalar>(
    id: &CaseId,
    mesh: Option<&str>,
) -> Result<(Vec<Case<F>>, Grouping), Failure> {
    if let Some(digest) = &id.parameters.mesh {
        let path = mesh.ok_or_else(|| {
            Failure::usage(format!("'{id}' is a case of a mesh: add --mesh FILE"))
        })?;
        let mesh = read_mesh(path, true)?;
        if mesh.digest != *digest {
            let message =
                format!("{path}: its digest is {}, the case's mesh has {digest}", mesh.digest);
            return Err(Failure::Message(Status::BadInput, message));
        }
        let family = MeshFamily::new(mesh, path);
        return Ok((vec![family.make(&id.parameters, id.seed, id.index)], Grouping::Single));
    }
    let (name, in_order) = match id.family.strip_suffix("-all") {
        Some(name) => (name, true),
        None => (id.family.as_str(), false),
    };
    let names = FAMILIES.iter().map(|family| family.name);
    let family =
        find(name).ok_or_else(|| unknown("family", name, names, "hairline list families"))?;
    if family.version != id.version {
        let message = format!(
            "'{id}' is of version {} of family '{name}', this program makes version {}",
            id.version, family.version
        );
        return Err(Failure::Message(Status::BadInput, message));
    }
    if family.size.map_or(in_order, |size| id.index >= size) {
        return Err(Failure::usage(format!("'{id}': family '{name}' has no case of that index")));
    }
    let made: Made<F> = if in_order {
        family.make_in_order(&id.parameters, id.index)
    } else {
        family.make(&id.parameters, id.seed, id.index)
    };
    let mut cases = made.cases().to_vec();
    if let Some(triangle) = id.triangle {
        let count = cases.len();
        let case = cases.get(triangle).copied().ok_or_else(|| {
            Failure::usage(format!("'{id}' has {count} triangles, counted from 0"))
        })?;
        cases = vec![case];
    }
    Ok((cases, family.grouping))
}

fn write_cases<F: Scalar>(
    out: &mut dyn Write,
    name: &str,
    cases: &[Case<F>],
    grouping: Grouping,
    rows: &[Row],
) -> io::Result<()> {
    let respawned = grouping == Grouping::Respawn;
    for (i, case) in cases.iter().enumerate() {
        if cases.len() > 1 {
            writeln!(out, "triangle {i} of {}", cases.len())?;
        }
        write_case(out, name, case)?;
        let truth = oracle::define(case).truth;
        for row in rows {
            write_row(out, case, &truth, respawned, row)?;
        }
    }
    if cases.len() > 1 {
        writeln!(out, "together")?;
        for row in rows {
            write_group(out, cases, grouping, row)?;
        }
    }
    Ok(())
}

/// What a contract asks of the triangles together, and what the kernel made of it.
fn write_group<F: Scalar>(
    out: &mut dyn Write,
    cases: &[Case<F>],
    grouping: Grouping,
    row: &Row,
) -> io::Result<()> {
    let truths: Vec<Truth> = cases.iter().map(oracle::truth).collect();
    let mut verdicts = vec![Verdict::miss(None); cases.len()];
    F::subject(row.entry).run(cases, &row.epsilons::<F>(), &mut verdicts);
    let hits = verdicts.iter().filter(|verdict| verdict.hit).count();
    let asked = group_truth(&truths, &row.contract, grouping);
    let judged = match (asked, hits) {
        (GroupTruth::Free, _) => "nothing is asked of the group",
        (GroupTruth::Crossing, 0) => "one hit is right: CRACK",
        (GroupTruth::Crossing, 1) => "one hit is right",
        (GroupTruth::Crossing, _) => "one hit is right: DOUBLE",
        (GroupTruth::Fold { odd }, hits) if (hits % 2 == 1) == odd => {
            "at a fold: the parity is right"
        }
        (GroupTruth::Fold { .. }, _) => "at a fold: the parity is WRONG",
    };
    writeln!(out, "{}: {hits} of {} triangles hit; {judged}", row.label(), cases.len())
}

fn write_case<F: Scalar>(out: &mut dyn Write, name: &str, case: &Case<F>) -> io::Result<()> {
    writeln!(out, "case {}", if name.trim_start().starts_with('{') { "as given" } else { name })?;
    let labels = ["origin", "direction", "a", "b", "c"];
    for (label, vector) in labels.into_iter().zip(case.vectors()) {
        let [x, y, z] = vector.map(|x| format!("{:e}", x.to_f64()));
        let bits = vector.map(F::hex).join(" ");
        writeln!(out, "    {label:<10} {x:>24} {y:>24} {z:>24}   {bits}")?;
    }
    let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
    writeln!(out, "    interval   [{}, {}]   {} {}", t_min, t_max, t_min.hex(), t_max.hex())?;
    let definition = oracle::define(case);
    writeln!(out, "truth {}", definition.truth)?;
    let kind = if F::NAME == f32::NAME {
        AnyCase::F32(narrowed(case))
    } else {
        AnyCase::F64(case.widen())
    };
    let stored = StoredCase { name: None, case: kind, truth: None, line: 1, why: None, url: None };
    let line = serde_json::to_string(&truth_line(&stored)).unwrap_or_default();
    writeln!(out, "    {line}")?;
    if let Some(severity) = exact_severity(case, Extent::Interval) {
        let (space, ulps) = (severity.in_space, severity.in_space * severity.edge_in_ulps);
        writeln!(
            out,
            "    the line passes {space:.3e} of the longest edge ({ulps:.3e} ulps) from the boundary"
        )?;
    }
    writeln!(out, "    as JSON: {}", lines::write_case(&stored))
}

/// A case of a scalar known to be `f32`.
fn narrowed<F: Float>(case: &Case<F>) -> Case<f32> {
    let [o, d, a, b, c] = case.vectors().map(|v| v.map(|x| x.to_f64() as f32));
    Case::new(o, d, [a, b, c]).on(case.ray.t_min.to_f64() as f32, case.ray.t_max.to_f64() as f32)
}

fn write_row<F: Scalar>(
    out: &mut dyn Write,
    case: &Case<F>,
    truth: &Truth,
    respawned: bool,
    row: &Row,
) -> io::Result<()> {
    let (subject, info) = (F::subject(row.entry), row.entry.info);
    let epsilons: Vec<F> = row.epsilons();
    let mut verdict = [Verdict::miss(None)];
    subject.run(std::slice::from_ref(case), &epsilons, &mut verdict);
    let [verdict] = verdict;
    let measured = subject.measure(case);
    let exact = subject.measure_exact(case);
    let exact_gates = subject.run_exact(case, &epsilons);
    let exact_hit = exact_gates.iter().all(|passes| *passes);

    let asked = if promises_direction::<F>(row.contract.direction, case.ray.direction.into()) {
        obligation(truth, &row.contract, respawned)
    } else {
        Obligation::Free
    };
    let finding = judge(asked, truth, info.gives, &verdict);
    let asked = match asked {
        Obligation::MustHit => "a hit",
        Obligation::MustMiss => "a miss",
        Obligation::Free => "nothing",
    };
    let said = if verdict.hit { "hit" } else { "miss" };
    let judged = finding.map_or("as it should".to_owned(), |finding| finding.name().to_uppercase());
    writeln!(out, "{}: {said}; its contract asks {asked}: {judged}", row.label())?;
    writeln!(out, "    contract: {}", row.contract.describe())?;
    for (i, gate) in info.gates.iter().enumerate() {
        let (margin, exact_margin) = (measured.margins[i], &exact.margins[i]);
        let decided = verdict.refused_by == Some(i as u8);
        let word = |passes: bool| if passes { "passes" } else { "refuses" };
        let decision = word(margin >= epsilons[i]);
        let should = word(exact_gates[i]);
        let mark = if decided { " <- decides" } else { "" };
        let wrong = if decision == should { "" } else { ", WRONG" };
        if gate.epsilon == Tunable::Fixed {
            let name = gate.name;
            writeln!(
                out,
                "    {name:<10} {decision} (exactly: {should}{wrong}){mark}   [refuses {}]",
                gate.refuses
            )?;
            continue;
        }
        writeln!(
            out,
            "    {:<10} margin {:>13} (exactly {:>13}) at e = {}: {decision} (exactly: {should}{wrong}){mark}   [refuses {}]",
            gate.name,
            format!("{:.6e}", margin.to_f64()),
            describe(exact_margin),
            row.epsilons[i],
            gate.refuses
        )?;
    }
    let exactly = if exact_hit { "hit" } else { "miss" };
    writeln!(out, "    the same formula without rounding: {exactly}")?;
    if verdict.hit {
        let mut values = Vec::new();
        if info.gives.t {
            values.push(format!("t = {:e}", verdict.t.to_f64()));
        }
        if info.gives.uv {
            values.push(format!("u = {:e}, v = {:e}", verdict.u.to_f64(), verdict.v.to_f64()));
        }
        if info.gives.facing {
            values.push(format!(
                "facing {}",
                verdict.facing.map_or("unknown", |facing| facing.name())
            ));
        }
        writeln!(out, "    reports {}", values.join(", "))?;
    }
    Ok(())
}

/// An exact number for people; its sign is exact.
fn describe(value: &Exact) -> String {
    use crate::arith::Real;
    if value.is_zero() { "0".to_owned() } else { format!("{:.6e}", value.approximate()) }
}
