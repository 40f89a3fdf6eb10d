//! The modules behind the library, for this project's own tests, benches, fuzz targets and league. All
//! of it may change at any time.

macro_rules! open {
    ($($module:ident),* $(,)?) => {
        $(pub mod $module {
            pub use crate::$module::*;
        })*
    };
}

open!(
    arith, audit, case, contract, corpus, epsilon, explore, family, files, judge, kernel, map,
    mesh, oracle, prove, record, report, selfcheck, offset, truth, vectors,
);

#[cfg(feature = "cli")]
open!(expect, plugin);

#[cfg(feature = "cli")]
pub mod cli {
    pub use crate::cli::check::read_settings;
    pub use crate::command::exit::{Failure, Status};
}
