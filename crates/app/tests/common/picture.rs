//! Pictures as tests read them.

use std::io::Cursor;

/// What a PNG says of itself, and its pixels.
pub fn pixels(png: &[u8], transformations: png::Transformations) -> (png::Info<'static>, Vec<u8>) {
    let mut decoder = png::Decoder::new(Cursor::new(png.to_vec()));
    decoder.set_transformations(transformations);
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    (reader.info().clone(), pixels)
}

/// The share in which two pictures differ by more than the edge of a letter does; 1 where their sizes do.
pub fn differing(one: &[u8], other: &[u8]) -> f64 {
    let of = |png| pixels(png, png::Transformations::EXPAND);
    let ((info, one), (other_info, other)) = (of(one), of(other));
    if (info.width, info.height, one.len()) != (other_info.width, other_info.height, other.len()) {
        return 1.0;
    }
    let apart = one.iter().zip(&other).filter(|(a, b)| a.abs_diff(**b) > 24).count();
    apart as f64 / one.len() as f64
}

/// What an SVG says, its lines joined.
pub fn words(svg: &str) -> String {
    let texts = svg.lines().filter(|line| line.starts_with("<text"));
    let plain = |line: &str| {
        let pieces = line.split('<').filter_map(|piece| Some(piece.split_once('>')?.1));
        pieces.collect::<String>()
    };
    texts.map(plain).collect::<Vec<_>>().join(" ")
}
