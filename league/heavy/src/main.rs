//! hairline with the kernels of this crate in it: `league-heavy audit --kernel bevy_picking`.

fn main() -> std::process::ExitCode {
    hairline::cli::main_with(hairline_league_heavy::kernels())
}
