//! The scene that a page begins with.

use std::path::Path;

use super::asked::{self, Flat, SYNTHETIC};
use super::records::Records;
use topple::scene::{Scene, SceneBuilder};

/// The first scene in flat keys. The files of its record, which are looked for from `folder`, are known from then on;
/// a scene that is shaken by a record without files has the synthetic pair.
pub fn first(records: &Records, scene: &Scene, given: &SceneBuilder, folder: &Path) -> Flat {
    let mut given = given.clone();
    if scene.excitation.record().is_some() {
        let record = given.record.get_or_insert_default();
        if record.horizontal.is_none() {
            record.horizontal = Some(SYNTHETIC.into());
        } else {
            for file in [&mut record.horizontal, &mut record.vertical].into_iter().flatten() {
                *file = records.know(&folder.join(&*file)).into();
            }
        }
    }
    asked::flat(scene, &given)
}
