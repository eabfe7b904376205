//! The frame that all map figures share: title, axes, and the place of the plot.

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::super::Map;
use super::document::{FINE, Place, compose};
use super::{FigureError, tick};
use crate::scene::grid::Axis;
use crate::scene::parameters::{Caption, PARAMETERS};
use crate::scene::{Directions, GRAVITY, Grid, Overturn, Parameter, Scene, Values};

/// Size of a map figure.
pub const SIZE: (u32, u32) = (960, 758);
/// Place of its plot.
pub const PLOT: Place = Place { x: 90, y: 76, width: 610, height: 610 };
/// White margin outside the axes' names.
const EDGE: i32 = 16;
/// Length of a tick.
const TICK: i32 = 5;

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

/// A document of a size: images, and on top of them what `paint` draws.
///
/// # Errors
/// [`FigureError::Draw`].
pub fn document(
    size: (u32, u32),
    images: &[(Place, Vec<u8>)],
    paint: impl FnOnce(&Area) -> Drawn<()>,
) -> Result<String, FigureError> {
    let mut drawing = String::new();
    let root = area(&mut drawing, size);
    let painted = paint(&root).and_then(|()| Ok(root.present()?));
    painted.map_err(|e| FigureError::Draw(e.to_string()))?;
    // What draws writes into the text until it goes.
    drop(root);
    Ok(compose(size, images, &drawing))
}

/// The two ends of an axis in its coordinates, half a cell beyond its first and last value.
pub fn extent(values: &Values) -> std::ops::Range<f64> {
    let last = (values.count() - 1) as f64;
    if last == 0.0 {
        let only = values.coordinate(0.0);
        let half = (only.abs() * 0.05).max(0.05);
        return only - half..only + half;
    }
    values.coordinate(-0.5)..values.coordinate(last + 0.5)
}

/// The parameters of a scene that its axes do not show, in one line.
pub fn caption(scene: &Scene) -> String {
    let single = |parameter: Parameter| scene.numbers.get(parameter)?.single();
    let mut parts = Vec::new();
    let shown = |when| PARAMETERS.iter().filter(move |entry| entry.caption == when);
    for entry in shown(Caption::Always) {
        if entry.parameter == Parameter::TH {
            match scene.isolation {
                Directions::Dual => {}
                Directions::Horizontal => parts.push("horizontal isolation alone".into()),
                Directions::Vertical => parts.push("vertical isolation alone".into()),
                Directions::None => parts.push("no isolation".into()),
            }
        }
        if entry.parameter == Parameter::Omega
            && let Some(pulse) = scene.excitation.other_pulse()
        {
            parts.push(pulse.into());
        }
        parts.extend(single(entry.parameter).map(|value| entry.written(value)));
    }
    for entry in shown(Caption::Unusual) {
        let usual = |value: f64| entry.default.parse() == Ok(value);
        let unusual = single(entry.parameter).filter(|value| !usual(*value));
        parts.extend(unusual.map(|value| entry.written(value)));
    }
    if scene.overturn == Overturn::QuarterTurn {
        parts.push("overturned at 90°".into());
    }
    let scaled = [Parameter::Scale, Parameter::Pga].map(|parameter| scene.numbers.get(parameter));
    let varies = scaled.into_iter().flatten().any(|values| values.count() > 1);
    if let Some(pair) = scene.excitation.record()
        && !varies
    {
        parts.push(format!(
            "PGA {:.3} g horizontal, {:.3} g vertical",
            pair.pga_h / GRAVITY,
            pair.pga_v / GRAVITY
        ));
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

/// Where a pair of axes lies, and what it says.
#[derive(Debug, Clone, Copy)]
pub struct Axes {
    /// Size of the document.
    pub size: (u32, u32),
    /// Place of the plot in it.
    pub plot: Place,
    /// Room for the axes' names and numbers, left of the plot and below it; none where a
    /// neighbour has them.
    pub room: (Option<i32>, Option<i32>),
    /// Size of the numbers; names are a fifth larger.
    pub font: i32,
}

/// An axis: its ends and its name.
pub struct Named {
    /// From where to where.
    pub ends: std::ops::Range<f64>,
    /// Symbol and unit.
    pub name: String,
}

impl Named {
    /// The axis of a grid; of none a single value without a name.
    fn of(axis: Option<&Axis>) -> Named {
        match axis {
            Some(axis) => Named { ends: extent(&axis.values), name: axis.entry().label() },
            None => Named { ends: 0.0..1.0, name: String::new() },
        }
    }
}

/// How an axis writes a number.
type Writing = dyn Fn(f64) -> String;

/// How the numbers of an axis are written at its coordinates.
fn writing(axis: Option<&Axis>) -> Box<Writing> {
    let Some(axis) = axis else { return Box::new(|_| String::new()) };
    let ends = extent(&axis.values);
    let width = (ends.end - ends.start).abs();
    let values = axis.values.clone();
    match &axis.values {
        // No number between those of a list.
        Values::List(_) => Box::new(move |at| match (at - at.round()).abs() < 1.0e-6 {
            true if at >= 0.0 && at < values.count() as f64 => format!("{}", values.value_at(at)),
            _ => String::new(),
        }),
        Values::Range(range) if range.log => Box::new(move |at| {
            let value = values.value_at(at);
            tick(value, value.abs())
        }),
        Values::Range(_) => Box::new(move |at| tick(at, width.max(1.0e-3))),
    }
}

/// Draws the frame of a plot over a grid, with its axes.
pub fn axes<'b>(root: &Area<'b>, grid: &Grid, axes: &Axes) -> Drawn<Plot<'b, 'b>> {
    let (x, y) = (Some(grid.x()), grid.y());
    let named = (&Named::of(x), &Named::of(y));
    frame_written(root, axes, named, (&*writing(x), &*writing(y)))
}

/// Draws the frame of a plot along one axis.
pub fn along<'b>(root: &Area<'b>, axis: &Axis, axes: &Axes) -> Drawn<Plot<'b, 'b>> {
    let named = (&Named::of(Some(axis)), &Named::of(None));
    frame_written(root, axes, named, (&*writing(Some(axis)), &*writing(None)))
}

/// Draws the frame of a plot, with its axes.
pub fn frame<'b>(root: &Area<'b>, axes: &Axes, (x, y): (&Named, &Named)) -> Drawn<Plot<'b, 'b>> {
    let width = (y.ends.end - y.ends.start).abs().max(1.0e-3);
    frame_with(root, axes, (x, y), &move |value| tick(value, width))
}

/// The same, the numbers of the vertical axis written in another way.
pub fn frame_with<'b>(
    root: &Area<'b>,
    axes: &Axes,
    (x, y): (&Named, &Named),
    written: &Writing,
) -> Drawn<Plot<'b, 'b>> {
    let width = (x.ends.end - x.ends.start).abs().max(1.0e-3);
    frame_written(root, axes, (x, y), (&move |value| tick(value, width), written))
}

/// The same, the numbers of both axes written in another way.
fn frame_written<'b>(
    root: &Area<'b>,
    axes: &Axes,
    (x, y): (&Named, &Named),
    (write_x, write_y): (&Writing, &Writing),
) -> Drawn<Plot<'b, 'b>> {
    let Axes { size, plot, room, font } = *axes;
    let right = size.0 as i32 - plot.x - plot.width;
    let bottom = size.1 as i32 - plot.y - plot.height;
    // Where nothing is written there are still the ticks.
    let (left_room, bottom_room) = (room.0.unwrap_or(TICK), room.1.unwrap_or(TICK));
    let mut chart = ChartBuilder::on(root)
        .margin_top(plot.y * FINE)
        .margin_right(right * FINE)
        .margin_left((plot.x - left_room) * FINE)
        .margin_bottom((bottom - bottom_room) * FINE)
        .set_label_area_size(LabelAreaPosition::Left, left_room * FINE)
        .set_label_area_size(LabelAreaPosition::Bottom, bottom_room * FINE)
        .build_cartesian_2d(x.ends.clone(), y.ends.clone())?;
    let format_x = |value: &f64| room.1.map_or(String::new(), |_| write_x(*value));
    let format_y = |value: &f64| room.0.map_or(String::new(), |_| write_y(*value));
    // A number for every so many units.
    let labels = |length: i32| (length / (font * 5)).clamp(3, 12) as usize;
    let mut mesh = chart.configure_mesh();
    mesh.disable_mesh()
        .x_labels(labels(plot.width))
        .y_labels(if plot.height < 4 * font { 0 } else { labels(plot.height) })
        .label_style(text(font))
        .axis_desc_style(text(font * 6 / 5))
        .set_all_tick_mark_size(TICK * FINE)
        .axis_style(stroke(BLACK, 10))
        .x_label_formatter(&format_x)
        .y_label_formatter(&format_y);
    if room.1.is_some() {
        mesh.x_desc(&x.name);
    }
    if room.0.is_some() {
        mesh.y_desc(&y.name);
    }
    mesh.draw()?;
    outline(root, plot, 10)?;
    Ok(chart)
}

/// The size of a caption's letters: smaller for a long one, so that it ends on the page.
fn caption_size(caption: &str) -> i32 {
    /// Mean width of a letter, over its size: three tenths in captions as they are.
    const WIDTH: f64 = 0.32;
    let room = f64::from(SIZE.0 as i32 - PLOT.x - EDGE);
    let letters = caption.chars().count().max(1) as f64;
    ((room / (WIDTH * letters)) as i32).clamp(9, 15)
}

/// A title with what a map is a slice at.
pub fn titled(title: &str, at: &str) -> String {
    match at {
        "" => title.into(),
        at => format!("{title}: {at}"),
    }
}

/// Draws a title and the caption of its scene, from `left` on.
pub fn heading(root: &Area, left: i32, scene: &Scene, title: &str) -> Drawn<()> {
    root.draw(&Text::new(title.to_string(), at(left, 20), text(22)))?;
    let caption = caption(scene);
    let size = caption_size(&caption);
    root.draw(&Text::new(caption, at(left, 49), text(size)))?;
    Ok(())
}

/// Draws title and caption, and the frame of a map's plot with its axes.
pub fn map_frame<'b>(root: &Area<'b>, map: &Map, title: &str) -> Drawn<Plot<'b, 'b>> {
    heading(root, PLOT.x, map.scene, title)?;
    let room = (Some(PLOT.x - EDGE), Some(SIZE.1 as i32 - PLOT.y - PLOT.height - EDGE));
    axes(root, &map.grid, &Axes { size: SIZE, plot: PLOT, room, font: 15 })
}
