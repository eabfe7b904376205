//! What the benches share.

use topple::scene::Scene;
use topple::scene::builder::SceneBuilder;

/// The map that is swept by default, of a given number of columns and rows.
pub fn pulse(side: u32) -> Scene {
    let text = format!(
        "[block]\nobject = 1\neccentricity = 0.2\n[base]\nt_h = 1.75\nt_v = 0.75\n\
         [pulse]\nomega = \"0.2:15:{side}\"\na_h = \"0.1:15:{side}\"\n"
    );
    SceneBuilder::from_toml(&text).unwrap().check().unwrap()
}
