//! hairline with the kernels of bevy_picking and truck-meshalgo in it, which are built here because their
//! dependencies are several times those of the league: `league-heavy audit --kernel bevy_picking`.

mod bevy_picking;
// What an entrant promises of which nothing is said.
#[allow(dead_code, reason = "the league's own use of it is the rest")]
#[path = "../../src/entrant.rs"]
mod entrant;
mod truck_meshalgo;

use entrant::{PROMISE, UNIT};

fn main() -> std::process::ExitCode {
    hairline::cli::main_with([bevy_picking::entry(), truck_meshalgo::entry()])
}
