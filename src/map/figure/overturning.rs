//! The overturning map, in the manner of the paper's Fig. 11.

use std::collections::BTreeSet;

use plotters::prelude::*;

use super::super::Map;
use super::FigureError;
use super::document::{Place, compose};
use super::palette::Kind;
use super::raster::png;
use super::tick;
use crate::scene::{Excitation, Range, Scene};

const SIZE: (u32, u32) = (960, 758);
const PLOT: Place = Place { x: 90, y: 76, width: 610, height: 610 };
/// White margin outside the axes' names, px.
const EDGE: i32 = 16;
/// Pixels of the hatch's image for each of the document's.
const HATCH_SCALE: usize = 2;
/// Distance of the hatch's lines, in its pixels.
const HATCH_PITCH: usize = 12;

/// Draws the map as SVG.
///
/// # Errors
/// Any [`FigureError`].
pub fn draw(map: &Map) -> Result<String, FigureError> {
    let (columns, rows) = map.grid.shape();
    let cells = png(columns, rows, |column, row| {
        let [r, g, b] = Kind::of(&map.outcomes[(rows - 1 - row) * columns + column]).colour();
        [r, g, b, 255]
    })?;
    let mut images = vec![(PLOT, cells)];
    let tensile = |index: usize| map.outcomes[index].min_contact < 0.0;
    let unresolved = |index: usize| Kind::of(&map.outcomes[index]) == Kind::Unresolved;
    let any = |test: &dyn Fn(usize) -> bool| (0..map.outcomes.len()).any(test);
    let hatched = any(&tensile);
    if hatched || any(&unresolved) {
        images.push((PLOT, hatch(columns, rows, &tensile, &unresolved)?));
    }
    let kinds: BTreeSet<Kind> = map.outcomes.iter().map(Kind::of).collect();
    let mut drawing = String::new();
    frame(map, &kinds, hatched, &mut drawing).map_err(|e| FigureError::Draw(e.to_string()))?;
    Ok(compose(SIZE, &images, &drawing))
}

/// Lines over the cells where the model does not hold, crosses over the unresolved ones.
fn hatch(
    columns: usize,
    rows: usize,
    tensile: &dyn Fn(usize) -> bool,
    unresolved: &dyn Fn(usize) -> bool,
) -> Result<Vec<u8>, FigureError> {
    let (width, height) = (PLOT.width as usize * HATCH_SCALE, PLOT.height as usize * HATCH_SCALE);
    png(width, height, |x, y| {
        let cell = (rows - 1 - y * rows / height) * columns + x * columns / width;
        let rising = (x + y) % HATCH_PITCH < 2;
        let falling = (x + height - y) % HATCH_PITCH < 2;
        match (unresolved(cell), tensile(cell)) {
            (true, _) if rising || falling => [0, 0, 0, 255],
            (false, true) if rising => [0, 0, 0, 150],
            _ => [0, 0, 0, 0],
        }
    })
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
    let Excitation::Pulse(pulse) = scene.excitation;
    parts.push(format!("A_v = {} m/s²", pulse.a_v));
    parts.join(",  ")
}

fn frame(
    map: &Map,
    kinds: &BTreeSet<Kind>,
    hatched: bool,
    drawing: &mut String,
) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(drawing, SIZE).into_drawing_area();
    let text = |size: i32| ("sans-serif", size).into_font().color(&BLACK);
    root.draw(&Text::new(map.scene.title.clone(), (PLOT.x, 20), text(22)))?;
    root.draw(&Text::new(caption(map.scene), (PLOT.x, 49), text(15)))?;
    let right = SIZE.0 as i32 - PLOT.x - PLOT.width;
    let bottom = SIZE.1 as i32 - PLOT.y - PLOT.height;
    let (x, y) = (&map.grid.x, &map.grid.y);
    let mut chart = ChartBuilder::on(&root)
        .margin_top(PLOT.y)
        .margin_right(right)
        .margin_left(EDGE)
        .margin_bottom(EDGE)
        .set_label_area_size(LabelAreaPosition::Left, PLOT.x - EDGE)
        .set_label_area_size(LabelAreaPosition::Bottom, bottom - EDGE)
        .build_cartesian_2d(extent(&x.range), extent(&y.range))?;
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc(format!("{} [{}]", x.symbol, x.unit))
        .y_desc(format!("{} [{}]", y.symbol, y.unit))
        .label_style(text(15))
        .axis_desc_style(text(18))
        .x_label_formatter(&|value| tick(*value, width(&x.range)))
        .y_label_formatter(&|value| tick(*value, width(&y.range)))
        .draw()?;
    let (x1, y1) = (PLOT.x + PLOT.width, PLOT.y + PLOT.height);
    root.draw(&Rectangle::new([(PLOT.x, PLOT.y), (x1, y1)], BLACK.stroke_width(1)))?;
    legend(&root, kinds, hatched, map)?;
    root.present()?;
    Ok(())
}

fn width(range: &Range) -> f64 {
    let ends = extent(range);
    (ends.end - ends.start).abs()
}

fn legend(
    root: &DrawingArea<SVGBackend, plotters::coord::Shift>,
    kinds: &BTreeSet<Kind>,
    hatched: bool,
    map: &Map,
) -> Result<(), Box<dyn std::error::Error>> {
    let font = |size: i32| ("sans-serif", size).into_font().color(&BLACK);
    let left = PLOT.x + PLOT.width + 22;
    let mut top = PLOT.y + 4;
    let total = map.outcomes.len() as f64;
    for &kind in kinds {
        let [r, g, b] = kind.colour();
        let area = [(left, top), (left + 24, top + 16)];
        root.draw(&Rectangle::new(area, RGBColor(r, g, b).filled()))?;
        if kind == Kind::Unresolved {
            root.draw(&PathElement::new(vec![area[0], area[1]], BLACK))?;
            root.draw(&PathElement::new(vec![(left, top + 16), (left + 24, top)], BLACK))?;
        }
        root.draw(&Rectangle::new(area, BLACK.stroke_width(1)))?;
        let count = map.outcomes.iter().filter(|outcome| Kind::of(outcome) == kind).count();
        let share = share(count as f64 / total);
        root.draw(&Text::new(kind.label(), (left + 32, top + 1), font(15)))?;
        let anchored = font(13).pos(plotters::style::text_anchor::Pos::new(
            plotters::style::text_anchor::HPos::Right,
            plotters::style::text_anchor::VPos::Top,
        ));
        root.draw(&Text::new(share, (SIZE.0 as i32 - 10, top + 2), anchored))?;
        top += 25;
    }
    if hatched {
        let area = [(left, top), (left + 24, top + 16)];
        for offset in [-8, 0, 8, 16] {
            let (x0, x1) = ((left + offset).max(left), (left + offset + 16).min(left + 24));
            let (y0, y1) = (top + 16 - (x0 - left - offset), top + 16 - (x1 - left - offset));
            root.draw(&PathElement::new(vec![(x0, y0), (x1, y1)], BLACK.stroke_width(1)))?;
        }
        root.draw(&Rectangle::new(area, BLACK.stroke_width(1)))?;
        let lines = ["contact force tensile:", "the model does not hold"];
        for (line, label) in lines.into_iter().enumerate() {
            root.draw(&Text::new(label, (left + 32, top + 1 + 18 * line as i32), font(15)))?;
        }
    }
    Ok(())
}

/// A share of the map in percent.
fn share(share: f64) -> String {
    let percent = 100.0 * share;
    if percent < 0.1 {
        return "< 0.1 %".into();
    }
    format!("{percent:.1} %")
}
