//! A scene under many settings of its numbers.

use super::varied::Varied;
use topple::scene::{Numbers, Scene, SceneError};

/// A scene, and the numbers of it that vary.
#[derive(Debug, Clone)]
pub struct Ensemble<'a> {
    scene: &'a Scene,
    varied: &'a [Varied],
}

/// Gives numbers the values of a point.
pub fn set(numbers: &mut Numbers, varied: &[Varied], point: &[f64]) {
    for (varied, value) in varied.iter().zip(point) {
        numbers.set(varied.parameter, *value);
    }
}

impl<'a> Ensemble<'a> {
    /// The scenes of parameters that vary, each of which has one value in the scene; `force` accepts improbable ones.
    ///
    /// # Errors
    /// A parameter that the scene does not have, that is an axis, or that is given twice; values that it cannot have.
    pub fn of(
        scene: &'a Scene,
        varied: &'a [Varied],
        force: bool,
    ) -> Result<Ensemble<'a>, SceneError> {
        for (number, one) in varied.iter().enumerate() {
            let key = one.parameter.key();
            let refused = |problem: &str| Err(SceneError::new("vary", format!("{key} {problem}")));
            if varied[..number].iter().any(|other| other.parameter == one.parameter) {
                return refused("varies twice; give it one distribution");
            }
            match scene.numbers.get(one.parameter) {
                None => {
                    return refused(&format!(
                        "is no number of this scene; give `{key}` a value, which the distribution replaces"
                    ));
                }
                Some(values) if values.count() > 1 => {
                    return refused(
                        "is an axis of the map; give it one value, or leave it out here",
                    );
                }
                Some(_) => one.check(force)?,
            }
        }
        Ok(Ensemble { scene, varied })
    }

    /// The scene at a point.
    ///
    /// # Errors
    /// Numbers that make no sense together, with their values.
    pub fn scene(&self, point: &[f64]) -> Result<Scene, SceneError> {
        let mut scene = self.scene.clone();
        set(&mut scene.numbers, self.varied, point);
        scene.check().map_err(|error| {
            let at = self.varied.iter().zip(point);
            let at: Vec<String> =
                at.map(|(varied, value)| format!("{} = {value}", varied.parameter.key())).collect();
            let problem = format!("at {}: `{}` {}", at.join(", "), error.key, error.problem);
            SceneError::new("vary", format!("{problem}; cut the distributions off"))
        })?;
        Ok(scene)
    }

    /// The scenes at points, in their order. All are checked before the first is handed out.
    ///
    /// # Errors
    /// Those of [`scene`](Ensemble::scene) at the first point that has one.
    pub fn scenes<'p>(
        &'p self,
        points: &'p [Vec<f64>],
    ) -> Result<impl Iterator<Item = Result<Scene, SceneError>> + 'p, SceneError> {
        for point in points {
            self.scene(point)?;
        }
        Ok(points.iter().map(|point| self.scene(point)))
    }
}
