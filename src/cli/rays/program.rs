//! The flags of a plain program that hairline runs itself: a triangle test in a tree of boxes.

use crate::audit::Row;
use crate::cli::exit::Failure;
use crate::cli::flags::unknown;
use crate::kernel::{EpsilonText, KERNELS, Scalar};
use clap::Args;
use hairline_boxes::{KERNELS as BOX_TESTS, Setup};
use hairline_rays::PlainProgram;

/// A program to judge in place of a file of answers.
#[derive(Args)]
pub struct ProgramArguments {
    /// Judge this triangle test, in a tree of boxes that hairline walks with it, in place of a file of answers
    #[arg(short = 'k', long, value_name = "NAME", conflicts_with = "answers", help_heading = PROGRAM)]
    kernel: Option<String>,

    /// Its epsilons, as `audit` takes them
    #[arg(long, value_name = "GATE=VALUE,...", requires = "kernel", conflicts_with = "answers", allow_hyphen_values = true, help_heading = PROGRAM)]
    epsilon: Option<String>,

    /// The slab test of its boxes (`hairline boxes list tests`) [default: none, every face is asked]
    #[arg(long, value_name = "NAME", requires = "kernel", conflicts_with = "answers", help_heading = PROGRAM)]
    box_test: Option<String>,

    /// An epsilon of the slab test, as padding=-1e-6
    #[arg(long, value_name = "GATE=VALUE", value_delimiter = ',', requires = "box_test", conflicts_with = "answers", allow_hyphen_values = true, help_heading = PROGRAM)]
    box_epsilon: Vec<String>,
}

/// The heading of these flags in the help.
const PROGRAM: &str = "A plain program";

impl ProgramArguments {
    /// True if a program is named.
    pub fn is_given(&self) -> bool {
        self.kernel.is_some()
    }

    /// The program, which has to run in a scalar.
    pub fn program<F: Scalar>(&self) -> Result<PlainProgram, Failure> {
        let name = self.kernel.as_deref().unwrap_or_default();
        let names = || KERNELS.iter().map(|entry| entry.info.name);
        if crate::kernel::find(name).is_none() {
            return Err(unknown("kernel", name, names(), "hairline list kernels"));
        }
        let kernel = Row::named(name, self.epsilon.as_deref(), "own").map_err(Failure::usage)?;
        kernel.check::<F>().map_err(Failure::usage)?;
        Ok(PlainProgram {
            kernel,
            box_test: self.box_setup()?,
        })
    }

    fn box_setup(&self) -> Result<Option<Setup>, Failure> {
        let Some(name) = &self.box_test else {
            return Ok(None);
        };
        let find = || BOX_TESTS.iter().find(|entry| entry.info.name == name);
        let names = BOX_TESTS.iter().map(|entry| entry.info.name);
        let entry =
            find().ok_or_else(|| unknown("slab test", name, names, "hairline boxes list tests"))?;
        let mut setup = Setup::published(entry).swap_remove(0);
        for given in &self.box_epsilon {
            let parts = given.split_once('=');
            let value = parts.and_then(|(_, value)| EpsilonText::of(value));
            let (Some((gate, _)), Some(value)) = (parts, value) else {
                let message =
                    format!("--box-epsilon: '{given}' is no GATE=VALUE, as padding=-1e-6");
                return Err(Failure::usage(message));
            };
            setup = setup.with(gate, value).map_err(Failure::usage)?;
        }
        Ok(Some(setup))
    }
}
