//! Test vectors, read from the table that `hairline vectors --format csv` writes.

use crate::structure::Triangle;
use crate::trace::DeviceRay;
use hairline_files::InputError;
use std::collections::HashSet;

/// A test: a ray, and a triangle or a group of them.
pub struct VectorTest<'a> {
    pub id: &'a str,
    pub triangles: Vec<Triangle>,
    pub ray: DeviceRay,
    /// True if the hits are counted.
    pub is_group: bool,
    pub demand: Demand,
    is_f32: bool,
}

/// Every reading of a test demands it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Demand {
    Hit,
    Miss,
    /// A count of hits of a group: one.
    ExactlyOne,
    /// A count of hits of a group: one or more.
    AtLeastOne,
    /// A specification says, or nothing is demanded.
    Other,
}

/// How many numbers end a row: origin, direction, t_min, t_max, and three corners.
const NUMBERS: usize = 17;

/// The columns before the numbers that are read here.
struct Columns {
    id: usize,
    triangle: usize,
    scalar: usize,
    group: usize,
    result: usize,
    ox: usize,
}

impl Columns {
    fn read(name: &str, head: &str) -> Result<Columns, InputError> {
        let names: Vec<&str> = head.split(',').collect();
        let column = |wanted: &str| {
            names.iter().position(|name| *name == wanted).ok_or_else(|| {
                InputError::at(
                    name,
                    1,
                    format!("no column is called {wanted}: expected vectors/core.csv, or what `hairline vectors --format csv` writes"),
                )
            })
        };
        Ok(Columns {
            id: column("id")?,
            triangle: column("triangle")?,
            scalar: column("scalar")?,
            group: column("group")?,
            result: column("result")?,
            ox: column("ox")?,
        })
    }
}

/// Reads all tests of a table.
pub fn read<'a>(name: &str, text: &'a str) -> Result<Vec<VectorTest<'a>>, InputError> {
    let mut lines = text.lines().enumerate();
    let head = lines.next().map_or("", |(_, head)| head);
    let columns = Columns::read(name, head)?;
    let mut tests: Vec<VectorTest> = Vec::new();
    let mut ids = HashSet::new();
    for (index, line) in lines {
        let wrong = |message: String| InputError::at(name, index + 1, message);
        let words: Vec<&str> = line.split(',').collect();
        if words.len() < columns.ox + NUMBERS {
            let count = columns.ox + NUMBERS;
            return Err(wrong(format!(
                "expected {count} columns, found {}",
                words.len()
            )));
        }
        let is_f32 = words[columns.scalar] == "f32";
        let numbers = match is_f32 {
            true => numbers(&words[columns.ox..][..NUMBERS]).map_err(wrong)?,
            // No GPU takes them; they are not asked.
            false => [0.0; NUMBERS],
        };
        let corner = |first: usize| [numbers[first], numbers[first + 1], numbers[first + 2]];
        let triangle = [corner(8), corner(11), corner(14)];
        if words[columns.triangle] != "0" {
            let group = tests.last_mut();
            let test = group
                .filter(|test| test.id == words[columns.id])
                .ok_or_else(|| wrong("a group begins with its second triangle".to_owned()))?;
            test.triangles.push(triangle);
            continue;
        }
        if !ids.insert(words[columns.id]) {
            return Err(wrong(format!("{} is there twice", words[columns.id])));
        }
        tests.push(VectorTest {
            id: words[columns.id],
            triangles: vec![triangle],
            ray: DeviceRay {
                origin: corner(0),
                t_min: numbers[6],
                direction: corner(3),
                t_max: numbers[7],
            },
            is_group: !words[columns.group].is_empty(),
            demand: match (words[columns.group], words[columns.result]) {
                ("", "hit") => Demand::Hit,
                ("", "miss") => Demand::Miss,
                ("exactly-one", _) => Demand::ExactlyOne,
                ("at-least-one", _) => Demand::AtLeastOne,
                _ => Demand::Other,
            },
            is_f32,
        });
    }
    match tests.is_empty() {
        true => Err(InputError::of(name, "there are no tests in it")),
        false => Ok(tests),
    }
}

fn numbers(words: &[&str]) -> Result<[f32; NUMBERS], String> {
    let mut numbers = [0.0; NUMBERS];
    for (number, word) in numbers.iter_mut().zip(words) {
        let bits = u32::from_str_radix(word, 16)
            .map_err(|_| format!("expected eight hexadecimal digits of a float, found '{word}'"))?;
        *number = f32::from_bits(bits);
    }
    Ok(numbers)
}

impl VectorTest<'_> {
    /// True if the specifications of GPUs allow to ask it.
    pub fn is_for_a_gpu(&self) -> bool {
        let DeviceRay {
            origin,
            t_min,
            direction,
            t_max,
        } = self.ray;
        let coordinates = self.triangles.as_flattened().as_flattened();
        let mut all = coordinates.iter().chain(&origin).chain(&direction);
        self.is_f32
            && all.all(|x| x.is_finite())
            && direction != [0.0; 3]
            && 0.0 <= t_min
            && t_min <= t_max
    }

    /// The topic or family: its name without the digest at its end.
    pub fn topic(&self) -> &str {
        self.id.rsplit_once('-').map_or(self.id, |(topic, _)| topic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str =
        "id,triangle,scalar,group,result,ox,oy,oz,dx,dy,dz,t_min,t_max,ax,ay,az,bx,by,bz,cx,cy,cz";

    fn row(start: &str, numbers: [f32; NUMBERS]) -> String {
        let words = numbers.map(|number| format!("{:08x}", number.to_bits()));
        format!("{start},{}", words.join(","))
    }

    fn ray_along_z() -> [f32; NUMBERS] {
        let mut numbers = [0.0; NUMBERS];
        [numbers[5], numbers[7]] = [1.0, f32::INFINITY];
        numbers
    }

    #[test]
    fn triangles_of_a_group_are_one_test() {
        let row = |start| row(start, ray_along_z());
        let [first, second, single] = [
            row("fan-1f,0,f32,exactly-one,hit"),
            row("fan-1f,1,f32,exactly-one,miss"),
            row("basics-2a,0,f32,,miss"),
        ];
        let text = [HEAD, &first, &second, &single].join("\n");
        let tests = read("core.csv", &text).unwrap();
        assert_eq!([2, 1], [0, 1].map(|test| tests[test].triangles.len()));
        assert!(tests[0].is_group && tests[0].demand == Demand::ExactlyOne);
        assert!(!tests[1].is_group && tests[1].demand == Demand::Miss);
        assert_eq!(tests[0].topic(), "fan");
    }

    #[test]
    fn rays_that_no_gpu_may_be_asked_about_are_not() {
        let changed = |place: usize, number: f32| {
            let mut numbers = ray_along_z();
            numbers[place] = number;
            let text = [HEAD, &row("x-0,0,f32,,hit", numbers)].join("\n");
            read("core.csv", &text).unwrap()[0].is_for_a_gpu()
        };
        assert!(changed(0, 1.0));
        let wrong = [
            (0, f32::NAN),
            (5, 0.0),
            (6, -1.0),
            (6, f32::NAN),
            (7, f32::NAN),
            (7, -1.0),
            (8, f32::INFINITY),
        ];
        for (place, number) in wrong {
            assert!(!changed(place, number), "{place} {number}");
        }
    }

    #[test]
    fn an_error_names_its_line() {
        let error = |text: &str| read("core.csv", text).err().unwrap().to_string();
        assert!(error("").starts_with("core.csv:1: no column is called id"));
        assert_eq!(error(HEAD), "core.csv: there are no tests in it");
        let short = error(&[HEAD, "x,0,f32,,hit,1"].join("\n"));
        assert_eq!(short, "core.csv:2: expected 22 columns, found 6");
        let bits = row("x,0,f32,,hit", ray_along_z()).replace("3f800000", "0x1p0");
        let wrong = error(&[HEAD, &bits].join("\n"));
        assert!(wrong.starts_with("core.csv:2: expected eight hexadecimal digits"));
        let alone = row("x,1,f32,,hit", ray_along_z());
        let alone = error(&[HEAD, &alone].join("\n"));
        assert_eq!(alone, "core.csv:2: a group begins with its second triangle");
        let first = row("x,0,f32,,hit", ray_along_z());
        let other = row("y,1,f32,,hit", ray_along_z());
        let joined = error(&[HEAD, &first, &other].join("\n"));
        assert_eq!(
            joined,
            "core.csv:3: a group begins with its second triangle"
        );
        let twice = error(&[HEAD, &first, &first].join("\n"));
        assert_eq!(twice, "core.csv:3: x is there twice");
    }
}
