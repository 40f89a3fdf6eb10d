//! The part of a study of epsilons that is compared with another: how often each kind of ray was wrong, and which epsilons were chosen.

use super::commands::of_kernel;
use super::record::{KnobPart, SceneKernelPart, SceneResult};
use super::words::label;
use hairline_record::{Comparable, NamedRate, NamedValue, Study};

impl Comparable for SceneResult {
    const STUDY: Study = Study::Epsilon;

    fn question(&self) -> String {
        let SceneResult {
            scene, flags, mesh, ..
        } = self;
        let mesh = mesh
            .as_ref()
            .map_or(String::new(), |mesh| format!("mesh {} ", mesh.digest));
        format!("{mesh}{scene}{flags}")
    }

    fn cases(&self) -> String {
        let SceneResult {
            seed,
            fresh_seed,
            count,
            ..
        } = self;
        format!("{seed} {fresh_seed} {count}")
    }

    fn counted(&self) -> Vec<NamedRate> {
        let tried = self
            .kernels
            .iter()
            .flat_map(|part| part.tried.iter().map(move |it| (part, it)));
        let counted = tried.flat_map(|(part, tried)| {
            part.counts
                .iter()
                .zip(&tried.wrong)
                .map(|(count, rate)| NamedRate {
                    what: format!(
                        "{} {} with {} epsilons, {}",
                        part.kernel,
                        part.scalar,
                        tried.name,
                        label(count)
                    ),
                    rate: rate.clone(),
                    command: Some(of_kernel(self, part)),
                })
        });
        counted.collect()
    }

    fn chosen(&self) -> Vec<NamedValue> {
        let knobs = self.kernels.iter().flat_map(|part| {
            part.knobs
                .iter()
                .zip(&part.tried[0].epsilons)
                .map(move |it| (part, it))
        });
        let chosen = |(part, (knob, value)): (&SceneKernelPart, (&KnobPart, &String))| {
            NamedValue::chosen(
                format!("{} {}: {}", part.kernel, part.scalar, knob.name),
                value,
            )
        };
        let contract = |part: &SceneKernelPart| {
            let what = format!("{} {}: contract", part.kernel, part.scalar);
            NamedValue::chosen(what, &part.contract)
        };
        knobs
            .map(chosen)
            .chain(self.kernels.iter().map(contract))
            .collect()
    }
}
