//! A suite of four made motions.

use super::room::Room;
use super::suites::samples;

/// Names with peaks and frequencies.
pub const MOTIONS: [(&str, f64, f64); 4] =
    [("a", 2.5, 4.0), ("b", 4.0, 3.0), ("c", 4.0, 7.0), ("d", 1.0, 5.0)];

impl Room {
    /// A room with list.csv of the motions.
    pub fn suite() -> Room {
        let room = Room::new();
        let mut list = "id,horizontal,vertical,dt,units\n".to_string();
        let put = |name: &str, samples: &[f64]| {
            room.write(name, samples.iter().map(|a| format!("{a:.6}\n")).collect::<String>());
        };
        for (name, peak, omega) in MOTIONS {
            put(&format!("{name}.txt"), &samples(peak, omega));
            put(&format!("{name}_v.txt"), &samples(0.4 * peak, 3.0 * omega));
            list += &format!("{name},{name}.txt,{name}_v.txt,0.02,m/s2\n");
        }
        room.write("list.csv", list);
        room
    }
}
