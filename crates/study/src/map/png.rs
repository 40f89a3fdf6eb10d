//! Maps as PNG: a computed panel for each kernel, then the exact one, with gaps between them, each pixel a square.

use super::{Ink, Map};
use hairline_core::{Error, ErrorKind};
use png::{BitDepth, ColorType, Encoder};

/// The most dots of a picture.
const MOST_DOTS: usize = 1 << 26;

/// The place of the gap's transparent colour, after the inks.
const CLEAR: u8 = Ink::ALL.len() as u8;

/// The picture of one or several kernels on the same inputs, `scale` dots to a pixel's side. The gaps between the panels are
/// transparent and eight dots wide. An error if the picture would have more than 2^26 dots.
pub fn png(maps: &[Map], scale: usize) -> Result<Vec<u8>, Error> {
    let exact = &maps[0];
    let [width, height] = exact.size();
    let wide = width
        .saturating_mul(scale)
        .saturating_add(GAP)
        .saturating_mul(maps.len())
        .saturating_add(width.saturating_mul(scale));
    let high = height.saturating_mul(scale);
    if !(1..=MOST_DOTS).contains(&wide.saturating_mul(high)) {
        let line = format!(
            "{width}x{height} pixels of {scale}x{scale} dots are no picture of 1 to 2^26 dots"
        );
        return Err(Error::new(ErrorKind::OutOfRange, line));
    }
    let mut dots = Vec::with_capacity(wide * high);
    for y in 0..height {
        let side = |ink: &dyn Fn(usize) -> Ink| -> Vec<u8> {
            (0..width)
                .flat_map(|x| std::iter::repeat_n(ink(y * width + x) as u8, scale))
                .collect()
        };
        let mut line = Vec::with_capacity(wide);
        for map in maps {
            line.extend(side(&|pixel| map.computed(pixel)));
            line.extend([CLEAR; GAP]);
        }
        line.extend(side(&|pixel| exact.exact(pixel)));
        for _ in 0..scale {
            dots.extend_from_slice(&line);
        }
    }
    let mut palette: Vec<u8> = Ink::ALL.iter().flat_map(|ink| ink.rgb()).collect();
    palette.extend([0; 3]);
    let mut opacity = vec![255; Ink::ALL.len()];
    opacity.push(0);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, wide as u32, high as u32);
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_palette(palette);
    encoder.set_trns(opacity);
    let written = encoder.write_header().and_then(|mut writer| {
        writer
            .write_image_data(&dots)
            .and_then(|()| writer.finish())
    });
    written.map_err(|error| {
        let line = format!("the picture cannot be encoded: {error}");
        Error::new(ErrorKind::OutOfRange, line)
    })?;
    Ok(bytes)
}

/// Dots between the panels.
const GAP: usize = 8;
