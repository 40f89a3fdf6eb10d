//! The readings of a program's numbers: in f64 or f32, as written or as the program moves and scales them first. The one that
//! explains most is judged by.

use super::RaysRun;
use crate::arith::ScalarName;
use crate::cli::exit::Failure;
use hairline_rays::{GivenSteps, Judgements, RaysResult, Tally};

/// Judgements by numbers of a scalar.
enum InScalar<'a> {
    F32(Judgements<'a, f32>),
    F64(Judgements<'a, f64>),
}

impl InScalar<'_> {
    fn tally(&self) -> &Tally {
        match self {
            InScalar::F32(judgements) => &judgements.tally,
            InScalar::F64(judgements) => &judgements.tally,
        }
    }

    /// How many are right by the numbers as written.
    fn right_as_written(&self) -> u64 {
        let by_another_reading = match self {
            InScalar::F32(judgements) => judgements.right_as_written,
            InScalar::F64(judgements) => judgements.right_as_written,
        };
        by_another_reading.unwrap_or(self.tally().right)
    }
}

impl<'a> RaysRun<'a> {
    /// In a scalar, or else in the likelier one; by mesh and rays as written, or as they are given to the program if that explains
    /// more.
    pub(super) fn judged_in(&self, scalar: Option<ScalarName>) -> Result<RaysResult, Failure> {
        let steps = self.steps()?;
        let written = self.judged_as_written(scalar)?;
        match steps.filter(|_| 0 < written.tally().wrong) {
            None => self.summary_of(&written),
            Some(steps) => self.judged_as_given(&steps, scalar, written),
        }
    }

    /// The steps of `--given`.
    fn steps(&self) -> Result<Option<GivenSteps>, Failure> {
        let Some(steps) = &self.arguments.answered.given else {
            return Ok(None);
        };
        let steps = GivenSteps::of(steps)
            .map_err(|message| Failure::usage(format!("--given: {message}")))?;
        match self.reads_standard_input() {
            true => Err(Failure::usage(
                "--given: rays and answers are read several times, so name files in place of standard input",
            )),
            false => Ok(Some(steps)),
        }
    }

    fn judged_as_given(
        &self,
        steps: &GivenSteps,
        scalar: Option<ScalarName>,
        written: InScalar<'a>,
    ) -> Result<RaysResult, Failure> {
        use ScalarName::{F32, F64};
        let [in_f64, in_f32] = [F64, F32].map(|computed_in| steps.mesh(self.mesh, computed_in));
        // Steps in f32 leave numbers of f32.
        let readings = [
            (&in_f64, F64, F64),
            (&in_f64, F64, F32),
            (&in_f32, F32, F32),
        ];
        let right_as_written = written.right_as_written();
        let mut best = written;
        let mut right_as_given = None;
        let mut failure = None;
        for (mesh, computed_in, read_in) in readings {
            if scalar.is_some_and(|scalar| scalar != read_in) {
                continue;
            }
            let run = RaysRun {
                mesh,
                given: Some((steps, computed_in)),
                ..*self
            };
            // Numbers that the scalar does not hold are not those of the program.
            match run.judged_by(read_in) {
                Err(error) => failure = Some(error),
                Ok(given) => {
                    right_as_given = right_as_given.max(Some(given.tally().right));
                    if best.tally().is_explained_better_by(given.tally()) {
                        best = given;
                    }
                }
            }
        }
        // Steps that leave no scene at all are wrong ones.
        if let (None, Some(failure)) = (right_as_given, failure) {
            return Err(failure);
        }
        let result = self.summary_of(&best)?;
        let right_as_written = match result.given {
            None => result.right_as_written,
            Some(_) => Some(right_as_written),
        };
        Ok(RaysResult {
            right_as_written,
            right_as_given,
            ..result
        })
    }

    fn judged_as_written(&self, scalar: Option<ScalarName>) -> Result<InScalar<'a>, Failure> {
        match scalar {
            Some(scalar) => self.judged_by(scalar),
            // A program that hairline runs computes in f64, and standard input is read once.
            None if self.arguments.program.is_given() || self.reads_standard_input() => {
                self.judged_by(ScalarName::F64)
            }
            None => self.judged_in_the_likelier_scalar(),
        }
    }

    fn judged_by(&self, scalar: ScalarName) -> Result<InScalar<'a>, Failure> {
        Ok(match scalar {
            ScalarName::F32 => InScalar::F32(self.judged()?),
            ScalarName::F64 => InScalar::F64(self.judged()?),
        })
    }

    /// In f64 if no answer is wrong there, or else in f32 if that explains more.
    fn judged_in_the_likelier_scalar(&self) -> Result<InScalar<'a>, Failure> {
        let in_f64 = self.judged::<f64>()?;
        if in_f64.tally.wrong == 0 {
            return Ok(InScalar::F64(in_f64));
        }
        // Numbers that f32 does not hold are of a program that computes in f64.
        let Ok(mut in_f32) = self.judged::<f32>() else {
            return Ok(InScalar::F64(in_f64));
        };
        if !in_f64.tally.is_explained_better_by(&in_f32.tally) {
            return Ok(InScalar::F64(in_f64));
        }
        let as_written = in_f64.right_as_written.unwrap_or(in_f64.tally.right);
        in_f32.right_as_written = Some(as_written);
        Ok(InScalar::F32(in_f32))
    }

    fn summary_of(&self, judgements: &InScalar) -> Result<RaysResult, Failure> {
        match judgements {
            InScalar::F32(judgements) => self.summary(judgements),
            InScalar::F64(judgements) => self.summary(judgements),
        }
    }
}
