//! hairline with the league's kernels in it: `league audit --kernel bvh,parry3d`.

fn main() -> std::process::ExitCode {
    hairline::cli::main_with(hairline_league::kernels())
}
