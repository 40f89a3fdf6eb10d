//! The screens on a terminal: no line is longer than it is wide but for commands to paste, and none has more lines than
//! people read.

use crate::program;

use program::{ends, scratch};
use rustix::fs::{Mode, OFlags, open};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{Winsize, tcsetwinsize};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

/// The text on a terminal of some columns, without its colours.
fn on_terminal(folder: &Path, columns: u16, arguments: &[&str]) -> String {
    let terminal = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
    grantpt(&terminal).unwrap();
    unlockpt(&terminal).unwrap();
    let name = ptsname(&terminal, Vec::new()).unwrap();
    let size = Winsize {
        ws_row: 50,
        ws_col: columns,
        ws_xpixel: 0,
        ws_ypixel: 0,
    };
    tcsetwinsize(&terminal, size).unwrap();
    let output = open(&name, OFlags::RDWR | OFlags::NOCTTY, Mode::empty()).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(arguments)
        .current_dir(folder)
        .stdout(Stdio::from(File::from(output)))
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    // What is written may be more than the terminal holds.
    let mut text = Vec::new();
    let reader = std::thread::spawn(move || {
        // At its end a terminal has no more readers, which is an error.
        let _ = File::from(terminal).read_to_end(&mut text);
        text
    });
    let code = child.wait().unwrap().code();
    assert!(
        code == Some(0) || code == Some(1),
        "{arguments:?}: {code:?}"
    );
    let text = String::from_utf8(reader.join().unwrap())
        .unwrap()
        .replace("\r\n", "\n");
    without_colours(&text)
}

/// A text without escapes of the form ESC [ … m.
fn without_colours(text: &str) -> String {
    let mut parts = text.split('\x1b');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |all, part| {
        all + part.split_once('m').map_or("", |(_, rest)| rest)
    })
}

/// Commands whose screens take seconds.
const SLOW: [&str; 2] = ["audit", "epsilon"];

#[test]
fn every_screen_fits_a_terminal() {
    let folder = scratch("terminal");
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpora/meshes/icosphere.obj");
    for (file, seed) in [("old.json", "1"), ("new.json", "2")] {
        let run = [
            "audit", "-q", "-n", "150", "--seed", seed, "--format", "json", "-o", file,
        ];
        ends(&folder, &run, 0);
    }
    let rays = "0.25,0.25,5,0,0,-1\n0.25,0.25,5,0,0,1\n0,0,9,0.1,0.2,-9\n";
    std::fs::write(folder.join("rays.csv"), rays).unwrap();
    std::fs::write(folder.join("answers.csv"), "7,1\n-1\n-1\n").unwrap();
    let sphere = mesh.to_str().unwrap();
    let screens: [(&[&str], usize); 14] = [
        (&["rays", sphere, "--ray", "0.25,0.25,5,0,0,-1"], 16),
        (&["rays", sphere, "rays.csv"], 16),
        (
            &["rays", sphere, "rays.csv", "--answers", "answers.csv"],
            34,
        ),
        (&["audit", "-n", "150"], 42),
        (&["audit", "-n", "150", "--kernel", "moller-trumbore"], 50),
        (
            &[
                "epsilon", "--scene", "room", "--scalar", "f32", "-n", "1000",
            ],
            31,
        ),
        (
            &[
                "epsilon",
                "--scene",
                "room",
                "--kernel",
                "moller-trumbore",
                "-n",
                "3000",
            ],
            52,
        ),
        (&["offset", "-n", "300", "--scalar", "f32"], 64),
        (
            &["explain", "edge-near@2/f32/-/1/41", "--kernel", "cramer"],
            40,
        ),
        (&["explain", "edge-near@2/f32/-/1/41"], 40),
        (
            &[
                "check",
                "--kernel",
                "moller-trumbore",
                "--family",
                "edge-near",
                "-n",
                "300",
            ],
            50,
        ),
        (&["diff", "old.json", "new.json"], 40),
        (
            &["prove", "--kernel", "moller-trumbore", "--scalar", "f32"],
            40,
        ),
        (&["mesh", mesh.to_str().unwrap(), "--scalar", "f32"], 40),
    ];
    let mut wrong = Vec::new();
    for (arguments, most) in screens {
        // What takes long is tried on the narrow one alone.
        let widths: &[u16] = if SLOW.contains(&arguments[0]) {
            &[80]
        } else {
            &[80, 100]
        };
        for &columns in widths {
            let text = on_terminal(&folder, columns, arguments);
            let lines: Vec<&str> = text.lines().collect();
            if lines.len() < 3 || most < lines.len() {
                wrong.push(format!(
                    "{arguments:?} at {columns}: {} lines\n{text}",
                    lines.len()
                ));
            }
            let is_pasted = |line: &&&str| {
                ["hairline ", "--details", "  use  "]
                    .iter()
                    .any(|part| line.contains(part))
            };
            let words = lines.iter().filter(|line| !is_pasted(line));
            let wide = words.filter(|line| usize::from(columns) < line.chars().count());
            wrong.extend(wide.map(|line| format!("{arguments:?} at {columns}: {line}")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn colours_are_escapes_that_can_be_taken_out() {
    assert_eq!(without_colours("a\x1b[1mb\x1b[0m\nc"), "ab\nc");
    let folder = scratch("terminal-colours");
    let run = [
        "audit", "-q", "-n", "50", "--kernel", "cramer", "--color", "always",
    ];
    let (coloured, _) = ends(&folder, &run, 0);
    assert!(coloured.contains("\x1b[1m") && !without_colours(&coloured).contains('\x1b'));
}
