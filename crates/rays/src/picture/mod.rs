//! A wrong answer as a picture: the mesh around the ray, the exact points, and those that were answered.

mod marks;
mod sight;
mod space;
mod stage;
mod surface;
mod view;

use crate::arith::Float;
use crate::asked::Answers;
use crate::record::group_digits;
use crate::report::page::{Drawing, Picture};
use hairline_scene::{InvalidRay, Nearest, Ray, Scene};
use sight::{Asked, Sight};
use stage::Stage;
use surface::Surface;
use view::{SIZE, View};

/// The picture of a ray; `hit` is the exact hit that an answer is about. `words` say what is wrong. An error if the ray means nothing.
pub(crate) fn of_ray<F: Float>(
    scene: &Scene<F>,
    ray: &Ray<F>,
    hit: Option<&Nearest>,
    answered: Option<(&Answers, usize)>,
    words: &str,
) -> Result<Option<Picture>, InvalidRay> {
    let sight = Sight::of_ray(scene, ray, hit, answered)?;
    Ok(picture(scene, &sight, words))
}

/// The picture of a point.
pub(crate) fn of_point<F: Float>(scene: &Scene<F>, point: [F; 3], words: &str) -> Option<Picture> {
    picture(scene, &Sight::of_point(scene, point), words)
}

/// The picture; none if the mesh has no face that is finite.
fn picture<F: Float>(scene: &Scene<F>, sight: &Sight, words: &str) -> Option<Picture> {
    let stage = Stage::of(scene, sight)?;
    let wished = stage.wished();
    let view = View::best(&wished);
    let surface = Surface::of(scene, &stage.region, &view, &wished);
    let caption = caption(words, sight, &stage, &surface);
    let [width, height] = SIZE;
    let frame = format!("<rect class=\"grid\" width=\"{width}\" height=\"{height}\"/>\n");
    let elements = surface.elements + &stage.marks(&view, sight) + &frame;
    Some(Picture {
        about: words.to_owned(),
        caption,
        drawing: Drawing::Chart(elements, SIZE),
    })
}

/// The words, and how to read the picture.
fn caption(words: &str, sight: &Sight, stage: &Stage, surface: &Surface) -> String {
    let mut sentences = vec![format!("{}.", capital(words))];
    let exact = match sight.asked {
        Asked::Ray(_) => "Green, with a dot: the exact hit.",
        Asked::Point(_) => "Green, with a dot: the nearest face.",
    };
    if !sight.exact.is_empty() {
        sentences.push(exact.to_owned());
    }
    if !sight.answered.is_empty() {
        sentences.push("Red, dashed, with a cross: the answer.".to_owned());
    }
    if stage.is_outside {
        sentences.push("The answered point is too far away to be shown.".to_owned());
    }
    if surface.has_lines {
        sentences.push("Faces that would hide it are lines only.".to_owned());
    }
    if surface.drawn < surface.seen {
        sentences.push(format!(
            "The {} faces nearest to the marks are drawn, of {} that lie here.",
            group_digits(surface.drawn as u64),
            group_digits(surface.seen as u64)
        ));
    }
    sentences.join(" ")
}

fn capital(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}
