//! The frame that all map figures share: title, axes, and the place of the plot.

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::super::Map;
use super::document::Place;
use super::tick;
use crate::scene::{Excitation, GRAVITY, Range, Scene};

/// Size of a map figure.
pub const SIZE: (u32, u32) = (960, 758);
/// Place of its plot.
pub const PLOT: Place = Place { x: 90, y: 76, width: 610, height: 610 };
/// Units of a drawing for each of the document's: the plotting library knows whole ones only.
pub const FINE: i32 = 8;
/// White margin outside the axes' names.
const EDGE: i32 = 16;

/// What drawing may fail with.
pub type Drawn<T> = Result<T, Box<dyn std::error::Error>>;
/// A drawing in fine units.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A plot in the units of its axes.
pub type Plot<'a, 'b> =
    ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Text of a size in the document's units.
pub fn text(size: i32) -> TextStyle<'static> {
    ("sans-serif", size * FINE).into_font().color(&BLACK)
}

/// The same, ending at its place.
pub fn text_left_of(size: i32) -> TextStyle<'static> {
    text(size).pos(Pos::new(HPos::Right, VPos::Top))
}

/// A place in the document, in fine units.
pub fn at(x: i32, y: i32) -> (i32, i32) {
    (x * FINE, y * FINE)
}

/// A stroke of a width in tenths of the document's units.
pub fn stroke(colour: RGBColor, tenths: i32) -> ShapeStyle {
    colour.stroke_width((tenths * FINE / 10) as u32)
}

/// An empty drawing of a document's size.
pub fn area(drawing: &mut String, size: (u32, u32)) -> Area<'_> {
    let fine = FINE as u32;
    SVGBackend::with_string(drawing, (size.0 * fine, size.1 * fine)).into_drawing_area()
}

/// The two ends of an axis, half a cell beyond its first and last value.
pub fn extent(range: &Range) -> std::ops::Range<f64> {
    if range.count == 1 {
        let half = (range.start.abs() * 0.05).max(0.05);
        return range.start - half..range.start + half;
    }
    let half = 0.5 * (range.stop - range.start) / f64::from(range.count - 1);
    range.start - half..range.stop + half
}

/// The parameters of a scene that its axes do not show, in one line.
pub fn caption(scene: &Scene) -> String {
    let block = &scene.block;
    let mut parts = vec![
        format!("B = {} m", block.half_width),
        format!("H = {} m", block.height),
        format!("ε = {}", block.eccentricity),
    ];
    let base = &scene.isolation;
    if base.horizontal.is_none() && base.vertical.is_none() {
        parts.push("no isolation".into());
    }
    let fixed = |range: &Range| (range.count == 1).then_some(range.start);
    if let Some(t_h) = base.horizontal.as_ref().and_then(|law| fixed(&law.t_h)) {
        parts.push(format!("T_h = {t_h} s"));
    }
    if let Some(t_v) = base.vertical.as_ref().and_then(|law| fixed(&law.t_v)) {
        parts.push(format!("T_v = {t_v} s"));
    }
    if scene.tilt != 0.0 {
        parts.push(format!("tilt {} rad", scene.tilt));
    }
    match &scene.excitation {
        Excitation::Pulse(pulse) => parts.push(format!("A_v = {} m/s²", pulse.a_v)),
        Excitation::Record(pair) => parts.push(format!(
            "PGA {:.3} g horizontal, {:.3} g vertical",
            pair.pga_h / GRAVITY,
            pair.pga_v / GRAVITY
        )),
    }
    parts.join(",  ")
}

/// Draws a place's outline; the library's own rectangles have hairlines only.
pub fn outline(root: &Area, place: Place, tenths: i32) -> Drawn<()> {
    let Place { x, y, width, height } = place;
    let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)];
    let path = corners.map(|(x, y)| at(x, y)).to_vec();
    root.draw(&PathElement::new(path, stroke(BLACK, tenths)))?;
    Ok(())
}

/// Draws title and caption, and the frame of a map's plot with its axes.
pub fn map_frame<'b>(root: &Area<'b>, map: &Map, title: &str) -> Drawn<Plot<'b, 'b>> {
    root.draw(&Text::new(title.to_string(), at(PLOT.x, 20), text(22)))?;
    root.draw(&Text::new(caption(map.scene), at(PLOT.x, 49), text(15)))?;
    let right = SIZE.0 as i32 - PLOT.x - PLOT.width;
    let bottom = SIZE.1 as i32 - PLOT.y - PLOT.height;
    let (x, y) = (&map.grid.x, &map.grid.y);
    let width = |range: &Range| (range.stop - range.start).abs().max(1.0e-3);
    let mut chart = ChartBuilder::on(root)
        .margin_top(PLOT.y * FINE)
        .margin_right(right * FINE)
        .margin_left(EDGE * FINE)
        .margin_bottom(EDGE * FINE)
        .set_label_area_size(LabelAreaPosition::Left, (PLOT.x - EDGE) * FINE)
        .set_label_area_size(LabelAreaPosition::Bottom, (bottom - EDGE) * FINE)
        .build_cartesian_2d(extent(&x.range), extent(&y.range))?;
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc(format!("{} [{}]", x.symbol, x.unit))
        .y_desc(format!("{} [{}]", y.symbol, y.unit))
        .label_style(text(15))
        .axis_desc_style(text(18))
        .set_all_tick_mark_size(5 * FINE)
        .axis_style(stroke(BLACK, 10))
        .x_label_formatter(&|value| tick(*value, width(&x.range)))
        .y_label_formatter(&|value| tick(*value, width(&y.range)))
        .draw()?;
    outline(root, PLOT, 10)?;
    Ok(chart)
}
