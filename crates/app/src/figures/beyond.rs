//! Figures that go beyond the paper's: boundaries, shares, motions.

use topple::backend::history;
use topple::scene::{Grid, Scene, Values};
use topple_lab::figures::animation::{self, Moving};
use topple_lab::figures::bisection::ReferenceWord;
use topple_lab::figures::boundary::{self, Bisection, Least};
use topple_lab::figures::shares::{self, Shares};
use topple_lab::figures::{Figure, curves, letter};

use super::super::errors::of_figure;
use super::super::interrupt;
use super::super::progress::Bar;
use super::{Work, plan};

/// Points of each curve at which the reference is asked.
const ASKED: usize = 4;

impl Work<'_> {
    /// The least amplitude that overturns, with isolation and without.
    pub(super) fn boundaries(&self, figure: &Figure) -> anyhow::Result<()> {
        let cells = figure.cells();
        let progress = Bar::new(2 * cells, self.options.quiet);
        let mut drawn = Vec::with_capacity(figure.panels.len());
        let mut all = ReferenceWord { asked: 0, found: 0, farthest: 0.0 };
        for (k, panel) in figure.panels.iter().enumerate() {
            let name = format!("{}-{}", figure.name, letter(k));
            let plan = |scene: &Scene| self.plan_of(scene, panel.fixed_step);
            let backends = std::slice::from_ref(&self.backend);
            let bisection = Bisection { backends, plan: &plan, asked: ASKED };
            let mut curve = |scene: &Scene| -> anyhow::Result<Vec<Least>> {
                let swept = self.sweep(scene, panel.fixed_step, &name, &progress)?;
                let least = boundary::least(scene, &swept, &bisection, interrupt::flag());
                let (least, word) = least.map_err(of_figure)?;
                all = all.with(word);
                Ok(least)
            };
            let isolated = curve(&panel.scene)?;
            let free = curve(&boundary::without_isolation(&panel.scene))?;
            self.out.write(&format!("{name}.csv"), |w| boundary::write(&isolated, &free, w))?;
            drawn.push((isolated, free));
        }
        progress.finish();
        let grid = Grid::of(&figure.panels[0].scene);
        let rows = grid.shape().1;
        let caption = format!(
            "The lowest of {rows} amplitudes that overturns, bisected in f64 to {:.0e} m/s²; at {} of {} points of the \
             curves the adaptive reference finds it, {:.0e} m/s² apart at most.",
            boundary::within(&grid),
            all.found,
            all.asked,
            all.farthest
        );
        let picture = curves::boundaries(figure, &drawn, &[caption, self.how()])?;
        let count: usize = drawn.iter().map(|(with, _)| 2 * with.len()).sum();
        self.picture(
            &figure.name,
            &picture,
            &format!("{count} boundaries, {} of them by the reference, too", all.asked),
        )
    }

    /// The shares of the outcomes against the eccentricity.
    pub(super) fn shares(&self, figure: &Figure) -> anyhow::Result<()> {
        let values = |k: usize| figure.panels[k].eccentricities.as_ref().map_or(0, Values::count);
        let cells: usize = (0..figure.panels.len())
            .map(|k| values(k) * Grid::of(&figure.panels[k].scene).len())
            .sum();
        let progress = Bar::new(cells, self.options.quiet);
        let mut drawn = Vec::with_capacity(figure.panels.len());
        for (k, panel) in figure.panels.iter().enumerate() {
            let name = format!("{}-{}", figure.name, letter(k));
            let mut rows: Vec<(f64, Shares)> = Vec::new();
            for eccentricity in panel.eccentricities.iter().flat_map(Values::iter) {
                let scene = shares::at(&panel.scene, eccentricity);
                rows.push((
                    eccentricity,
                    Shares::of(&self.sweep(&scene, panel.fixed_step, &name, &progress)?),
                ));
            }
            self.out.write(&format!("{name}.csv"), |w| shares::write(&rows, w))?;
            drawn.push(rows);
        }
        progress.finish();
        let picture = curves::shares(figure, &drawn, &[self.how()])?;
        self.picture(&figure.name, &picture, &format!("{cells} cells"))
    }

    /// Cells in motion.
    pub(super) fn motion(&self, figure: &Figure) -> anyhow::Result<()> {
        for (k, panel) in figure.panels.iter().enumerate() {
            let name = format!("{}-{}", figure.name, letter(k));
            let scenes: Vec<Scene> =
                panel.cells.iter().filter_map(|cell| cell.scene(&panel.scene)).collect();
            let mut moving = Vec::with_capacity(scenes.len());
            for (cell, scene) in panel.cells.iter().zip(&scenes) {
                let by_steps = plan(self.options, scene, panel.fixed_step, &name)?;
                let (rows, outcome) = history::by_steps::<f64>(&by_steps, &scene.case());
                moving.push(Moving::new(cell, scene, rows, outcome));
            }
            let bytes = animation::draw(&figure.title, &moving)?;
            self.out.write(&format!("{name}.gif"), |w| std::io::Write::write_all(w, &bytes))?;
            let place = self.out.file(&format!("{name}.gif"));
            self.say(&format!("{name:10} {} cells in motion; {}", moving.len(), place.display()));
        }
        Ok(())
    }
}
