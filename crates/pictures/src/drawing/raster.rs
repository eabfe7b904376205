//! Pixels as PNG, with a table of colours in place of four bytes a pixel.

use std::collections::HashMap;
use std::io::Cursor;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use png::{
    BitDepth, ColorType, Compression, Decoder, DecodingError, Encoder, Filter, PixelDimensions,
    Reader, Transformations, Unit,
};

use super::MILLIMETRE;
use super::error::FigureError;

/// Red, green, blue and opacity.
pub type Rgba = [u8; 4];

/// Metres of an inch.
const METRES: f32 = 0.0254;
/// Most colours of a table.
const COLOURS: usize = 256;

/// An image of `width` by `height` pixels, the top row first, as a PNG.
pub fn png(
    (width, height): (usize, usize),
    pixel: impl Fn(usize, usize) -> Rgba,
) -> Result<Vec<u8>, FigureError> {
    let mut pixels = Vec::with_capacity(width * height);
    for row in 0..height {
        pixels.extend((0..width).map(|column| pixel(column, row)));
    }
    encode((width, height), &pixels, None)
}

/// Pixels as a PNG. Of more than 256 colours the rarest, which soften the edges of letters and lines,
/// become those nearest to them. What is to be printed has so many pixels an inch.
pub fn encode(
    (width, height): (usize, usize),
    pixels: &[Rgba],
    per_inch: Option<f32>,
) -> Result<Vec<u8>, FigureError> {
    let failed = |e: &dyn std::fmt::Display| FigureError::Encode(e.to_string());
    let side = |n: usize| u32::try_from(n).map_err(|e| failed(&e));
    let (table, numbers) = table(pixels);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, side(width)?, side(height)?);
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    // Numbers of a table are no amounts: the differences that a filter takes between them are packed worse.
    encoder.set_filter(Filter::NoFilter);
    encoder.set_pixel_dims(per_inch.map(|per_inch| {
        let per_metre = (per_inch / METRES).round() as u32;
        PixelDimensions { xppu: per_metre, yppu: per_metre, unit: Unit::Meter }
    }));
    encoder.set_palette(table.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect::<Vec<u8>>());
    if table.iter().any(|[.., opacity]| *opacity < 255) {
        encoder.set_trns(table.iter().map(|colour| colour[3]).collect::<Vec<u8>>());
    }
    let mut writer = encoder.write_header().map_err(|e| failed(&e))?;
    let mut data = Vec::with_capacity(pixels.len());
    for_runs(pixels, |colour, length| {
        data.resize(data.len() + length, numbers.get(&colour).copied().unwrap_or(0));
    });
    writer.write_image_data(&data).map_err(|e| failed(&e))?;
    writer.finish().map_err(|e| failed(&e))?;
    Ok(bytes)
}

/// Calls with each run of pixels of one colour: most pixels are like the one before.
fn for_runs(pixels: &[Rgba], mut run: impl FnMut(Rgba, usize)) {
    for alike in pixels.chunk_by(|a, b| a == b) {
        run(alike[0], alike.len());
    }
}

/// The colours of a table, and the number of the one that stands for each colour there is.
fn table(pixels: &[Rgba]) -> (Vec<Rgba>, HashMap<Rgba, u8>) {
    let mut counts: HashMap<Rgba, usize> = HashMap::new();
    for_runs(pixels, |colour, length| *counts.entry(colour).or_default() += length);
    let mut colours: Vec<(Rgba, usize)> = counts.into_iter().collect();
    // By the colour too, so that the table is the same in every run.
    colours.sort_by_key(|&(colour, count)| (std::cmp::Reverse(count), colour));
    let table: Vec<Rgba> = colours.iter().take(COLOURS).map(|(colour, _)| *colour).collect();
    let apart = |a: &Rgba, b: &Rgba| -> i32 {
        a.iter().zip(b).map(|(a, b)| (i32::from(*a) - i32::from(*b)).pow(2)).sum()
    };
    let nearest = |colour: &Rgba| {
        let all = table.iter().enumerate();
        all.min_by_key(|(_, known)| apart(known, colour)).map_or(0, |(k, _)| k)
    };
    let number = |(k, (colour, _)): (usize, &(Rgba, usize))| {
        // A table has 256 colours at most.
        let number = if k < COLOURS { k } else { nearest(colour) } as u8;
        (*colour, number)
    };
    let numbers = colours.iter().enumerate().map(number).collect();
    (table, numbers)
}

/// The head of a PNG, which is read with four bytes a pixel, or with a grey and an opacity.
fn reader(png: &[u8]) -> Result<Reader<Cursor<&[u8]>>, FigureError> {
    let mut decoder = Decoder::new(Cursor::new(png));
    decoder.set_transformations(Transformations::normalize_to_color8() | Transformations::ALPHA);
    decoder.read_info().map_err(unread)
}

fn unread(error: DecodingError) -> FigureError {
    FigureError::Encode(error.to_string())
}

/// Width and height of a PNG in pixels, and its pixels, the top row first.
///
/// # Errors
/// [`FigureError::Encode`]: no PNG.
pub(super) fn decode(png: &[u8]) -> Result<((u32, u32), Vec<Rgba>), FigureError> {
    let mut reader = reader(png)?;
    let size = reader.output_buffer_size();
    let size = size.ok_or_else(|| FigureError::Encode("no memory for an image".into()))?;
    let mut bytes = vec![0; size];
    let frame = reader.next_frame(&mut bytes).map_err(unread)?;
    let pixels = bytes[..frame.buffer_size()].chunks_exact(frame.color_type.samples());
    let pixels = pixels.map(|pixel| match *pixel {
        [grey, opacity] => [grey, grey, grey, opacity],
        [r, g, b, opacity] => [r, g, b, opacity],
        _ => [0; 4],
    });
    Ok(((frame.width, frame.height), pixels.collect()))
}

/// A PNG whose pixels are opaque colours of a table, as it is packed.
pub(super) struct Packed {
    pub size: (u32, u32),
    /// Bits of a pixel.
    pub bits: u8,
    /// Red, green and blue of each colour.
    pub table: Vec<u8>,
    /// Lines of pixels, each behind the number of its filter, as zlib packs them.
    pub data: Vec<u8>,
}

/// A PNG without unpacking it; none where its pixels are not opaque colours of a table, row by row.
pub(super) fn packed(png: &[u8]) -> Option<Packed> {
    let reader = reader(png).ok()?;
    let info = reader.info();
    let is_plain = info.color_type == ColorType::Indexed && !info.interlaced;
    let table = info.palette.as_ref().filter(|_| is_plain && info.trns.is_none())?.to_vec();
    let mut data = Vec::new();
    let mut rest = png.get(8..)?;
    // Length, name, content and check sum of each chunk.
    while let Some((head, after)) = rest.split_first_chunk::<8>() {
        let [a, b, c, d, name @ ..] = *head;
        let length = u32::from_be_bytes([a, b, c, d]) as usize;
        if name == *b"IDAT" {
            data.extend(after.get(..length)?);
        }
        rest = after.get(length.checked_add(4)?..)?;
    }
    Some(Packed { size: (info.width, info.height), bits: info.bit_depth as u8, table, data })
}

/// Width and height of a PNG in points: those that it says, or a point a pixel.
///
/// # Errors
/// [`FigureError::Encode`]: no PNG.
pub(super) fn size(png: &[u8]) -> Result<(f64, f64), FigureError> {
    let reader = reader(png)?;
    let info = reader.info();
    let known =
        info.pixel_dims.filter(|size| size.unit == Unit::Meter && size.xppu > 0 && size.yppu > 0);
    let points = |pixels: u32, per_metre: Option<u32>| {
        per_metre.map_or(1.0, |per_metre| 1000.0 * MILLIMETRE / f64::from(per_metre))
            * f64::from(pixels)
    };
    Ok((
        points(info.width, known.map(|size| size.xppu)),
        points(info.height, known.map(|size| size.yppu)),
    ))
}

/// A PNG as the address of an embedded image.
pub fn data_url(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}
