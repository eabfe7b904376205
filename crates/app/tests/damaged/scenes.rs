//! Scenes, the numbers in them, and what else is written in words.

use topple::model::precision::Precision;
use topple::results::shard::Shard;
use topple::scene::{Grid, Scene, SceneBuilder, Values};
use topple::sweep::settings::Method;
use topple_lab::figures::motions;
use topple_studies::{Distribution, Varied};
use topple_studies::{Intensity, Uncertainty};

pub fn files() -> Vec<Vec<u8>> {
    let texts = [
        "title = \"A\"\n[block]\nobject = 1\neccentricity = 0.2\n[base]\nt_h = 1.75\nt_v = 0.75\n\
         [pulse]\nomega = \"0.2:15:40\"\na_h = \"1:2:4:log\"\n[run]\nt_max = 30\n",
        "[block]\nhalf_width = [0.1, 0.2, 0.3]\nheight = \"1:2:3\"\nmass = 100\nplate_h = 10\n\
         [base]\nisolation = \"horizontal\"\nt_h = \"1:4:4\"\npsi = 0.1\nu_y = 0.01\nbouc_wen_n = \"1,2\"\n\
         [pulse]\nshape = \"mavroeidis-papageorgiou\"\nomega = 5\na_h = 4\ngamma = \"1.5,2\"\nphase = 1\n\
         [run]\nx = \"t_h\"\ny = \"height\"\novertum = \"quarter-turn\"\n",
        "[block]\nsize = 2\nslenderness = 4\n[base]\nisolation = \"none\"\n\
         [pulse]\nomega = 5\na_h = 4\na_v = 1\n[run]\ntilt = 0.01\nfriction = 0.5\nrestitution = 0.9\n",
    ];
    texts.map(|text| text.replace("overtum", "overturn").into_bytes()).to_vec()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Plans a scene for each method: what is planned takes steps that can be counted.
pub fn plan(scene: &Scene) -> Result<(), String> {
    let finest = Method { precision: Precision::F64, repair: true, ..Method::default() };
    for method in [Method::default(), finest] {
        let plan = method.plan(scene).map_err(|error| error.to_string())?;
        let grid = Grid::of(scene);
        let last = grid.case(grid.len() - 1);
        for case in grid.corners().chain([last]) {
            let clock = plan.at(method.precision).clock(&case);
            assert!(clock.steps > 0 && clock.step_forced.is_finite(), "{clock:?}");
        }
    }
    Ok(())
}

pub fn read(bytes: &[u8]) -> Result<(), String> {
    let given = SceneBuilder::from_toml(&text(bytes))?;
    let scene = given.check().map_err(|error| error.to_string())?;
    let again = SceneBuilder::from_toml(&given.to_toml()?)?;
    // The order of its keys is not kept.
    assert!(again.check().is_ok_and(|again| Grid::of(&again).len() == Grid::of(&scene).len()));
    plan(&scene)
}

pub fn values() -> Vec<Vec<u8>> {
    let texts = "1.75 0.2:15:400 0.01:10:50:log 1,2,4 t_h=normal(1.75,0.1,1,2) a_h=uniform(1,2) t_v=lognormal(0.5,0.3) \
                 normal(0.5,0.1) 3/16 avg-sa:1.5 sa:0.5 pga*";
    texts.split(' ').map(|text| text.as_bytes().to_vec()).collect()
}

/// The text as each thing that it may be; the first that it is counts.
pub fn value(bytes: &[u8]) -> Result<(), String> {
    let text = text(bytes);
    let mut errors = Vec::new();
    match text.parse::<Values>() {
        Ok(values) => {
            values.check().unwrap();
            assert_eq!(values.to_string().parse::<Values>().unwrap(), values);
            assert!(values.iter().take(100).all(|value| !value.is_nan()));
            let (_, _) = (values.coordinate(0.5), values.value_at(0.5));
            return Ok(());
        }
        Err(error) => errors.push(error.to_string()),
    }
    match text.parse::<Varied>() {
        Ok(varied) => return drawn(varied),
        Err(error) => errors.push(error.to_string()),
    }
    match text.parse::<Distribution>() {
        Ok(distribution) => {
            assert!([0.1, 0.5, 0.9].iter().all(|share| !distribution.quantile(*share).is_nan()));
            return Ok(());
        }
        Err(error) => errors.push(error.to_string()),
    }
    match text.parse::<Shard>() {
        Ok(part) => {
            assert!(part.cells(1000).end <= 1000);
            return Ok(());
        }
        Err(error) => errors.push(error.to_string()),
    }
    match text.parse::<Intensity>() {
        Ok(_) => return Ok(()),
        Err(error) => errors.push(error.to_string()),
    }
    // All of them in one line.
    Err(errors.join("; "))
}

/// A number that is not known, as one of a scene that has all numbers of a base and a pulse.
fn drawn(varied: Varied) -> Result<(), String> {
    let scene = SceneBuilder::from_toml(&text(&files()[0])).unwrap();
    let scene = scene.check().unwrap();
    let uncertainty = Uncertainty { vary: vec![varied], pixel: true, samples: 4, seed: 1 };
    uncertainty.check(&scene, true).map(|_| ()).or_else(|error| match error.problem.as_str() {
        // It is an axis of this scene, and could be read all the same.
        problem if problem.contains("is an axis") => Ok(()),
        _ => Err(error.to_string()),
    })
}

pub fn motions() -> Vec<Vec<u8>> {
    let component = |name: &str| {
        format!("[kobe.{name}]\nfile = \"none.at2\"\ndt = 0.01\nunits = \"g\"\nstand_in = 5\n")
    };
    let text = format!(
        "[kobe]\nname = \"Kobe\"\ntitle = \"A title\"\n{}{}",
        component("horizontal"),
        component("vertical")
    );
    vec![text.into_bytes()]
}

/// Motions of figures: without files they are synthetic, of a peak that is given.
pub fn motion(bytes: &[u8]) -> Result<(), String> {
    let read = motions::from_toml("here", &text(bytes)).map_err(|error| error.to_string())?;
    for motion in read.values() {
        let motion = motion.open(None).map_err(|error| error.to_string())?;
        motion.pair.check().unwrap();
    }
    Ok(())
}
