//! What a picture of a map needs: the classes of cells with their colours, and the caption of a scene.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::json;
use topple::scene::words;
use topple::{Class, Outcome, Scene, Written};
use topple_pictures::colours::palette::{
    CURVES, DOTTED, FALLEN, Kind, MARKED, ROCKS, dots, is_dotted,
};
use topple_pictures::colours::print_palette::{Palette, Texture};
use topple_pictures::colours::ramp;
use topple_pictures::drawing::print::{Print, PrintError};
use topple_pictures::map::figure::fields;

use crate::errors::of_keyword;

/// The colours of pictures in a palette as JSON: `kinds` of cells, each with its label, its colour, the lines over it and
/// the colour of lines and dots on it; the word on dots and the colour under them in a legend, the colour of overturned
/// cells on a map of a quantity and the greys of its values, the columns of which a small value is dark, the colours of
/// curves, and the one behind a motion while the block rocks.
#[pyfunction]
pub fn palette(name: &str) -> PyResult<String> {
    let Some(palette) = Palette::of_key(name) else {
        let known: Vec<&str> = Palette::ALL.iter().map(|palette| palette.key()).collect();
        let problem = format!("no palette is called {name}; there are {}", known.join(", "));
        return Err(of_keyword("palette", problem));
    };
    let kinds = Kind::all().into_iter().map(|kind| {
        let colour = palette.of(kind.colour());
        let texture = match palette.texture(kind.colour()) {
            Texture::Plain => "",
            Texture::Across => "across",
            Texture::Upright => "upright",
        };
        json!({ "label": kind.label(), "colour": colour, "texture": texture, "over": dots(colour) })
    });
    let entries = kinds.collect::<Vec<_>>();
    let greys = (0..=255_u8).map(|k| [ramp::grey(f64::from(k) / 255.0); 3]);
    let told = json!({
        "kinds": entries,
        "dotted": DOTTED,
        "marked": palette.of(MARKED),
        "fallen": palette.of(FALLEN),
        "greys": greys.collect::<Vec<_>>(),
        "falls": fields::falling(),
        "curves": CURVES.map(|colour| palette.of(colour)),
        "rocks": palette.of(ROCKS),
    });
    Ok(told.to_string())
}

/// Refuses a width of a picture, mm, and a size of letters, points, that the command refuses.
#[pyfunction]
pub fn check_print(width: f64, font_size: Option<f64>) -> PyResult<()> {
    let checked = Print::new(Some(width), font_size);
    checked.map(|_| ()).map_err(|error| match error {
        PrintError::FontSize(_) => of_keyword("font_size", error),
        error => of_keyword("width", error),
    })
}

/// An array a class of cells, and where dots lie.
type Classes<'py> = (Bound<'py, PyArray1<u8>>, Bound<'py, PyArray1<bool>>);

/// The class of each cell as its place in the palette, and whether dots lie over it.
#[pyfunction]
pub fn kinds<'py>(
    py: Python<'py>,
    outcome: PyReadonlyArray1<'py, u8>,
    impacts: PyReadonlyArray1<'py, u32>,
    uplifts: PyReadonlyArray1<'py, u32>,
) -> PyResult<Classes<'py>> {
    let (outcome, impacts, uplifts) =
        (outcome.as_slice()?, impacts.as_slice()?, uplifts.as_slice()?);
    if impacts.len() != outcome.len() || uplifts.len() != outcome.len() {
        return Err(PyValueError::new_err("outcome, impacts and uplifts differ in their lengths"));
    }
    let all = Kind::all();
    let cells = outcome.iter().zip(impacts).zip(uplifts).map(|((code, impacts), uplifts)| {
        let class = Class::ALL.get(usize::from(*code)).copied().unwrap_or(Class::Unresolved);
        Outcome { class, impacts: *impacts, uplifts: *uplifts, ..Outcome::PENDING }
    });
    let (places, dots): (Vec<u8>, Vec<bool>) = cells
        .map(|cell| {
            let kind = Kind::of(&cell);
            let place = all.iter().position(|known| *known == kind).unwrap_or(all.len() - 1);
            (place as u8, is_dotted(&cell))
        })
        .unzip();
    Ok((PyArray1::from_vec(py, places), PyArray1::from_vec(py, dots)))
}

/// Shares of a whole as a legend tells them, in percent.
#[pyfunction]
pub fn shares(counts: Vec<usize>) -> Vec<String> {
    topple_pictures::drawing::share::shares(&counts)
}

/// The parameters of a scene that its axes do not show, in a line; `scene` is JSON.
#[pyfunction]
pub fn caption(scene: &str) -> PyResult<String> {
    let scene: Scene = serde_json::from_str(scene).map_err(|error| {
        PyValueError::new_err(format!("no scene of this version of topple: {error}"))
    })?;
    Ok(words::line(&scene))
}
