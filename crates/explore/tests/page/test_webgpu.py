"""The engine of the exported page in Chromium, on SwiftShader's WebGPU, against the library.

`cargo test --test explore exported::` writes what the library has; `python -m pytest crates/explore/tests/page/test_webgpu.py` compares.
"""

import http.server
import json
import os
import pathlib
import threading

import pytest

pytest.importorskip("playwright.sync_api")

ROOT = pathlib.Path(__file__).parents[4]
PAGE = ROOT / "crates/explore/src/page"
EXPORTED = pathlib.Path(os.environ.get("TOPPLE_EXPORTED", ROOT / "target/tmp/exported"))
CHROMIUM = os.environ.get("TOPPLE_CHROMIUM", "/usr/bin/chromium")
SOFTWARE = [
    "--no-sandbox",
    "--headless=new",
    "--enable-unsafe-webgpu",
    "--enable-features=Vulkan,WebGPU",
    "--use-webgpu-adapter=swiftshader",
    "--use-vulkan=swiftshader",
    "--use-angle=swiftshader",
    "--disable-vulkan-surface",
    "--ignore-gpu-blocklist",
]
SCENES = sorted(EXPORTED.glob("scene-*.json"), key=lambda path: int(path.stem.split("-")[1]))
NAMES = [json.loads(path.read_text())["name"] for path in SCENES]


class Handler(http.server.SimpleHTTPRequestHandler):
    """Serves the exported page, its modules as they are now, and under /library/ what the library wrote."""

    extensions_map = {".js": "text/javascript", ".html": "text/html", ".json": "application/json", ".css": "text/css", ".svg": "image/svg+xml"}

    def translate_path(self, path):
        path = path.split("?")[0].lstrip("/")
        if path.startswith("library/"):
            return str(EXPORTED / path.removeprefix("library/"))
        now = PAGE / path
        return str(now if path.endswith(".js") and now.is_file() else EXPORTED / "page" / path)

    def do_GET(self):
        if self.path == "/blank":
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.end_headers()
            self.wfile.write(b"<!doctype html><title>engine</title>")
        else:
            super().do_GET()

    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def address():
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()


@pytest.fixture(scope="module")
def browser(driver):
    own = driver.chromium.launch(executable_path=CHROMIUM, args=SOFTWARE)
    yield own
    own.close()


@pytest.fixture(scope="module")
def plain(driver):
    """A browser that has no GPU to give."""
    own = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--headless=new"])
    yield own
    own.close()


@pytest.fixture(scope="module")
def page(browser, address):
    page = browser.new_page()
    page.set_default_timeout(120_000)
    page.goto(address + "blank")
    page.evaluate(LIBRARY)
    return page


LIBRARY = """async () => {
  const of = async (name) => (await fetch(name)).json();
  const { learn } = await import('/gpu/known.js');
  learn(await of('/library/model.json'));
  const { Device } = await import('/gpu/device.js');
  const source = await (await fetch('/sweep.wgsl')).text();
  const right = 'p * push_h - q * push_v';
  if (source.split(right).length !== 2) throw Error('the shader has no such line');
  const [device, wrong] = [await Device.open(source), await Device.open(source.replace(right, 'p * push_h + q * push_v'))];
  window.engine = { of, device, wrong };
}"""

# Each part of a scene: words that differ from the library's, and the first outcomes that do.
COMPARE = """async ([file, spoiled]) => {
  const { of } = window.engine;
  const device = spoiled === 'shader' ? window.engine.wrong : window.engine.device;
  const { known } = await import('/gpu/known.js');
  const { sceneOf } = await import('/gpu/scene.js');
  const { partsOf } = await import('/gpu/plan.js');
  const { CellTables, stepWords } = await import('/gpu/tables.js');
  const { tileOf } = await import('/gpu/tile.js');
  const { LoadedTile } = await import('/gpu/loaded.js');
  const { samplesOf, sweepCells } = await import('/gpu/sweep.js');
  const { Pace } = await import('/gpu/pace.js');
  const library = await of(file);
  if (spoiled === 'gravity') known.gravity *= 1 + 1e-7;
  try {
    const scene = sceneOf(library.scene, library.count);
    const { grid } = scene;
    const parts = partsOf(scene, grid, null);
    const differ = (words, other) => {
      if (words.length !== other.length) return -1;
      return words.reduce((sum, word, k) => sum + (word !== other[k]), 0);
    };
    const reals = (entries) => new Uint32Array(Float32Array.from(entries.flat()).buffer);
    const told = { parts: [parts.length, library.parts.length], words: {}, kinds: {}, differences: [] };
    const add = (name, count) => { told.words[name] = (told.words[name] ?? 0) + count; };
    for (const [k, part] of parts.entries()) {
      const { tables, cells } = library.parts[k];
      const list = part.cells === null ? null : cells;
      const own = new CellTables(part.plan, grid, { first: 0, count: cells.length, list });
      add('numbers of cells', differ(part.cells ?? cells, cells));
      add('bodies', differ(reals(own.bodies.entries.map((body) => body.model)), tables.bodies));
      for (const name of ['horizontal', 'vertical', 'drive']) add(name, differ(reals(own[name].entries), tables[name]));
      if (tables.clocks !== null) add('clocks', own.ownClocks ? -1 : differ(stepWords(own.clocks.entries), tables.clocks));
      // As the device makes them of the tables.
      const tile = tileOf(own);
      const loaded = new LoadedTile(device, await device.pipelines(part.plan.constants), tile, samplesOf(part.plan.record), cells.length);
      const encoder = device.gpu.createCommandEncoder();
      loaded.encodeBegin(encoder);
      await loaded.submit(encoder);
      for (const [name, size] of [['cells', known.words_of.cell], ['states', known.words_of.state]]) {
        add(name, differ(await loaded.contents(name, 4 * size * cells.length), tables[name]));
      }
      loaded.free();
    }
    const outcomes = [];
    await sweepCells(device, new Pace(), scene, grid, null, (place, outcome) => { outcomes[place] = outcome; });
    const apart = [];
    (library.outcomes ?? []).forEach((theirs, cell) => {
      const mine = outcomes[cell];
      told.kinds[mine.outcome] = (told.kinds[mine.outcome] ?? 0) + 1;
      for (const name of ['outcome', 'status', 'impacts', 'uplifts']) {
        if (mine[name] !== theirs[name]) told.differences.push([cell, name, mine[name], theirs[name]]);
      }
      if (mine.outcome === 'rocking') apart.push(Math.abs(mine.zeta - theirs.zeta));
    });
    apart.sort((a, b) => a - b);
    told.zeta = apart[apart.length >> 1] ?? 0;
    return told;
  } finally {
    if (spoiled === 'gravity') known.gravity /= 1 + 1e-7;
  }
}"""


def test_the_library_has_written_what_is_compared():
    assert len(SCENES) > 20, f"{EXPORTED} has {len(SCENES)} scenes: run `cargo test --test explore exported::` first"
    assert any(json.loads(path.read_text())["outcomes"] for path in SCENES), "no adapter has computed outcomes"


@pytest.mark.parametrize("scene", SCENES, ids=NAMES)
def test_a_scene_has_the_librarys_words_and_outcomes(page, scene):
    told = page.evaluate(COMPARE, [f"/library/{scene.name}", None])
    assert told["parts"][0] == told["parts"][1]
    assert all(count == 0 for count in told["words"].values()), told["words"]
    assert told["differences"] == []
    # As crates/lab/tests/lab/agreement.rs has it: rounding leaves 2e-6, a wrong sign in the smallest term 4e-4.
    assert told["zeta"] <= 1e-5


RANDOM = """async () => {
  const { of, device } = window.engine;
  const { known } = await import('/gpu/known.js');
  const { sceneOf } = await import('/gpu/scene.js');
  const { partsOf } = await import('/gpu/plan.js');
  const { CellTables } = await import('/gpu/tables.js');
  const { tileOf } = await import('/gpu/tile.js');
  const { LoadedTile } = await import('/gpu/loaded.js');
  const { samplesOf } = await import('/gpu/sweep.js');
  const { count, scenes } = await of('/library/random.json');
  const told = { cells: 0, refused: 0, wrong: [] };
  for (const { scene: text, parts: theirs, refused } of scenes) {
    let scene = null;
    let key = null;
    try { scene = sceneOf(text, count); } catch (error) { if (error.name !== 'EngineError') throw error; key = error.key; }
    if (!scene || !theirs) {
      told.refused += 1;
      if (key !== (refused ?? null)) told.wrong.push([text, key, refused ?? null]);
      continue;
    }
    const parts = partsOf(scene, scene.grid, null);
    if (parts.length !== theirs.length) { told.wrong.push([text, 'parts', parts.length, theirs.length]); continue; }
    for (const [k, { plan, cells }] of parts.entries()) {
      const { cells: numbers, tables } = theirs[k];
      const own = new CellTables(plan, scene.grid, { first: 0, count: numbers.length, list: cells && numbers });
      const tile = tileOf(own);
      // The kernel that makes cells depends on no constant of the model.
      const variant = await device.pipelines({ workgroup_size: known.workgroup });
      const loaded = new LoadedTile(device, variant, tile, samplesOf(plan.record), numbers.length);
      const encoder = device.gpu.createCommandEncoder();
      loaded.encodeBegin(encoder);
      await loaded.submit(encoder);
      for (const [name, size] of [['cells', known.words_of.cell], ['states', known.words_of.state]]) {
        const words = await loaded.contents(name, 4 * size * numbers.length);
        const at = words.findIndex((word, place) => word !== tables[name][place]);
        if (at >= 0) told.wrong.push([text, name, Math.floor(at / size), at % size, words[at], tables[name][at]]);
      }
      const bodies = new Uint32Array(tile.models.buffer);
      if (bodies.some((word, place) => word !== tables.bodies[place])) told.wrong.push([text, 'bodies']);
      loaded.free();
      told.cells += numbers.length;
    }
  }
  return told;
}"""


def test_cells_of_random_scenes_are_the_librarys(page):
    told = page.evaluate(RANDOM)
    print(told["cells"], told["refused"])
    assert told["wrong"] == []
    assert told["cells"] > 7000 and told["refused"] > 70


# What the page shows and what its engine refuses, for every combination of choices and each number.
CHOICES = """async () => {
  const { of } = window.engine;
  const { applies } = await import('/applies.js');
  const { sceneOf } = await import('/gpu/scene.js');
  const { about, scenes } = await of('/library/choices.json');
  const told = { scenes: 0, refused: 0, wrong: [] };
  for (const { scene, shown, refused } of scenes) {
    told.scenes += 1;
    const own = about.parameters.map(({ key }) => key).filter((key) => applies(about, { scene, suite: '' }, key));
    if (String(own) !== String(shown)) told.wrong.push([scene, own, shown]);
    for (const [key, [value, theirs]] of Object.entries(refused)) {
      let found = null;
      try { sceneOf({ ...scene, [key]: value }, null); } catch (error) { if (error.name !== 'EngineError') throw error; found = error.key; }
      told.refused += found !== null;
      if (found !== theirs) told.wrong.push([scene, key, found, theirs]);
    }
  }
  return told;
}"""


def test_the_page_shows_and_refuses_the_numbers_that_the_library_takes_and_refuses(page):
    told = page.evaluate(CHOICES)
    assert told["wrong"] == []
    assert told["scenes"] == 64 and told["refused"] > 500


# Entries of the tables of a list of a thousand cells, both of whose axes go into one table.
LARGE = """async () => {
  const { sceneOf } = await import('/gpu/scene.js');
  const { partsOf } = await import('/gpu/plan.js');
  const { CellTables } = await import('/gpu/tables.js');
  const text = { half_width: '0.1:0.4', height: '0.5:2', isolation: 'none', omega: '5', a_h: '4', x: 'half_width', y: 'height', force: 'true' };
  const scene = sceneOf(text, [8193, 8193]);
  const list = Array.from({ length: 1000 }, (_, k) => 67108 * k + 3);
  const [{ plan }] = partsOf(scene, scene.grid, list);
  const own = new CellTables(plan, scene.grid, { first: 0, count: list.length, list });
  return ['bodies', 'horizontal', 'vertical', 'drive', 'readers'].map((name) => own[name].entries.length);
}"""


def test_tables_of_a_list_have_no_more_entries_than_it_has_cells(page):
    assert max(page.evaluate(LARGE)) == 1000


def test_a_mistake_in_a_number_shows(page):
    told = page.evaluate(COMPARE, [f"/library/{SCENES[0].name}", "gravity"])
    assert told["words"]["bodies"] > 0


def test_a_mistake_in_the_shader_shows(page):
    told = page.evaluate(COMPARE, [f"/library/{SCENES[0].name}", "shader"])
    assert all(count == 0 for count in told["words"].values())
    assert len(told["differences"]) > 0


# A scene, and what the tests of the engine share.
ENGINE = """
  const { open } = await import('/gpu/engine.js');
  const engine = await open();
  const scene = {
    object: '1', eccentricity: '0.2', t_h: '1.75', t_v: '0.75', omega: '0.2:15', a_h: '0.1:15', x: 'omega', y: 'a_h',
  };
  const failed = async (promise) => {
    try { await promise; } catch (error) { return { name: error.name, key: error.key, line: error.line, lost: error.lost }; }
    return null;
  };
  // Frames without words of how far a picture is.
  const pictured = (heard) => (frame) => { if (frame.stage) heard(frame); };
  const frames = async (request) => {
    const all = [];
    await engine.map(request, pictured((frame) => all.push(frame)));
    return all;
  };
"""


def test_a_view_comes_coarse_then_refined_with_the_cells_of_the_whole(page):
    told = page.evaluate(f"""async () => {{ {ENGINE}
      const columns = ['outcome', 'impacts', 'zeta', 'no_such_column'];
      const [coarse, refined, ...more] = await frames({{ tab: 'a', view: 1, scene, count: [120, 120], columns }});
      const {{ sceneOf }} = await import('/gpu/scene.js');
      const {{ sweepCells }} = await import('/gpu/sweep.js');
      const {{ Columns }} = await import('/gpu/outcome.js');
      const whole = sceneOf(scene, refined.shape);
      const all = new Columns(whole.grid.length, ['impacts']);
      await sweepCells(engine.device, engine.pace, whole, whole.grid, null, (k, outcome, mu) => all.put(k, outcome, mu));
      let differ = 0;
      for (let k = 0; k < whole.grid.length; k += 1) differ += all.arrays.kind[k] !== refined.arrays.kind[k];
      const beside = [0, 1].map((k) => coarse.arrays.kind.every((kind, at) => {{
        const [x, y] = [at % coarse.shape[0], Math.floor(at / coarse.shape[0])];
        return refined.arrays.kind[2 * y * refined.shape[0] + 2 * x] === kind;
      }}));
      return {{
        differ, beside, more: more.length, stages: [coarse.stage, refined.stage], shapes: [coarse.shape, refined.shape],
        cells: refined.cells, probes: refined.probes, x: refined.x, log: refined.log, adapter: refined.adapter, note: refined.note,
        types: Object.fromEntries(Object.entries(refined.arrays).map(([name, array]) => [name, array.constructor.name])),
      }};
    }}""")
    assert told["stages"] == ["coarse", "refined"] and told["more"] == 0
    assert told["shapes"] == [[61, 61], [121, 121]]
    assert told["x"] == [0.2, 15] and told["log"] == [False, False] and told["note"] == ""
    assert told["types"] == {
        "kind": "Uint8Array",
        "marks": "Uint8Array",
        "outcome": "Uint8Array",
        "impacts": "Uint32Array",
        "zeta": "Float32Array",
    }
    assert all(told["beside"]), "cells of the coarse picture are cells of the refined one"
    # Fewer than a half ran, and what did not differs where a region is smaller than a coarse cell.
    assert told["cells"] < 121 * 121 // 2
    assert told["differ"] <= 121 * 121 // 200
    assert told["probes"]["probes"] == 500 and told["probes"]["share_missed_at_most"] < 0.03


def test_probes_find_what_the_coarser_picture_has_missed(page):
    """A stripe of one cell's width lies between the cells of the coarser picture."""
    told = page.evaluate("""async () => {
      const { Refinement, drawn, shareAtMost } = await import('/gpu/refine.js');
      const side = 121;
      const refined = async (kindOf) => {
        const columns = (many, every) => ({
          arrays: {
            kind: Uint8Array.from({ length: many * many }, (_, k) => kindOf((k % many) * every, Math.floor(k / many) * every)),
            marks: new Uint8Array(many * many),
          },
        });
        const fine = { arrays: { kind: new Uint8Array(side * side), marks: new Uint8Array(side * side) } };
        fine.copy = (to, from, at) => { for (const name of ['kind', 'marks']) fine.arrays[name][to] = from.arrays[name][at]; };
        const ran = new Set();
        const run = async (cells) => {
          for (const cell of cells) {
            if (ran.has(cell)) throw Error('a cell runs twice');
            ran.add(cell);
            fine.arrays.kind[cell] = kindOf(cell % side, Math.floor(cell / side));
          }
        };
        const half = (side + 1) / 2;
        const { cells, probes } = await new Refinement(columns(half, 2), [half, half], [side, side]).fill(fine, run);
        const alone = fine.arrays.marks.filter((mark) => mark & 8).length;
        const found = fine.arrays.kind.filter((kind) => kind === 1).length;
        return { cells, ran: ran.size, probes, alone, found };
      };
      const strata = drawn(Array.from({ length: 1000 }, (_, k) => k), 100, Math.random).every((cell, k) => cell >= 10 * k && cell < 10 * k + 10);
      return {
        stripe: await refined((x) => Number(x === 61)),
        plain: await refined(() => 0),
        strata,
        shares: [shareAtMost(0, 500, 1), shareAtMost(3, 500, 1), shareAtMost(5, 5, 1), shareAtMost(0, 500, 4)],
      };
    }""")
    plain, stripe = told["plain"], told["stripe"]
    assert told["strata"]
    assert plain["probes"]["probes"] == plain["cells"] == 500 and plain["probes"]["missed"] == 0
    assert plain["cells"] == plain["ran"] and plain["alone"] == 121 * 121 - 61 * 61 - 500
    assert stripe["cells"] == stripe["ran"] > 500 and stripe["found"] > 60
    # Clopper and Pearson's one-sided limit at 95 %, of one draw and of the last of up to four.
    assert told["shares"] == pytest.approx([0.0059736, 0.0154337, 1.0, 0.0087258], rel=1e-3)
    # The page makes up to four draws.
    assert plain["probes"]["share_missed_at_most"] == pytest.approx(0.0087258, rel=1e-3)


def test_a_newer_view_and_an_aborted_one_end(page):
    told = page.evaluate(f"""async () => {{ {ENGINE}
      const request = {{ tab: 'a', view: 1, scene, count: [200, 200], columns: [] }};
      const older = failed(engine.map(request, () => {{}}));
      const newer = frames({{ ...request, view: 2, count: [20, 20] }});
      const stop = new AbortController();
      let seen = 0;
      const ended = failed(engine.map({{ ...request, tab: 'b' }}, pictured(() => {{ seen += 1; stop.abort(); }}), stop.signal));
      return [await older, (await newer).length, await ended, seen];
    }}""")
    assert told[0]["name"] == "AbortError" and told[1] == 1
    assert told[2]["name"] == "AbortError" and told[3] == 1


def test_a_lost_device_is_told_and_opened_again(page):
    told = page.evaluate(f"""async () => {{ {ENGINE}
      const request = {{ tab: 'a', view: 1, scene, count: [200, 200], columns: [] }};
      const first = engine.device;
      const lost = failed(engine.map(request, pictured(() => first.gpu.destroy())));
      const error = await lost;
      const again = await frames({{ ...request, count: [20, 20] }});
      return [error, again.length, first !== engine.device];
    }}""")
    assert told[0]["name"] == "EngineError" and told[0]["lost"] is True
    assert "lost" in told[0]["line"]
    assert told[1:] == [1, True]


@pytest.mark.parametrize(
    "change, key, said",
    [
        ({"t_h": "-1"}, "t_h", "positive"),
        ({"t_h": ""}, "t_h", "finite number"),
        ({"t_h": "3e3"}, "t_h", "plausible"),
        ({"object": "4"}, "object", "1, 2 or 3"),
        ({"isolation": "both"}, "isolation", "dual"),
        ({"isolation": "vertical"}, "t_h", "locked"),
        ({"omega": "3"}, "omega", "start:stop"),
        ({"omega": "-3:3:log"}, "omega", "cross zero"),
        ({"y": "omega"}, "y", "other axis"),
        ({"offset": "0.1"}, "offset", "says it too"),
        ({"gamma": "2"}, "gamma", "mavroeidis-papageorgiou"),
        ({"colour": "1"}, "colour", "no number"),
        ({"tilt": "0.9"}, "tilt", "overturning angle"),
        ({"horizontal": "mine.at2"}, "horizontal", "exported without"),
        ({"t_v": "1e-5"}, "t_v", "too stiff"),
    ],
)
def test_bad_input_names_its_key(page, change, key, said):
    error = page.evaluate(
        f"""async (change) => {{ {ENGINE}
      return failed(engine.map({{ tab: 'a', view: 1, scene: {{ ...scene, ...change }}, count: [16, 16] }}, () => {{}}));
    }}""",
        change,
    )
    assert error["name"] == "EngineError" and error["key"] == key
    assert said in error["line"] and "`" not in error["line"]


def test_a_view_so_deep_that_f32_ends_says_so(page):
    notes = page.evaluate(f"""async () => {{ {ENGINE}
      const of = async (omega) => (await frames({{ tab: 'a', scene: {{ ...scene, omega }}, count: [40, 20] }}))[0].note;
      return [await of('4:4.1'), await of('4:4.00001')];
    }}""")
    assert notes[0] == "" and "f32" in notes[1]


def test_a_line_has_the_cells_of_the_map(page):
    told = page.evaluate(f"""async () => {{ {ENGINE}
      const [frame] = await frames({{ tab: 'a', scene, count: [41, 41], columns: ['impacts'] }});
      const line = await engine.section({{ scene, from: [0.2, 0.1], to: [15, 15], count: 41 }});
      const diagonal = Array.from({{ length: 41 }}, (_, k) => frame.arrays.kind[42 * k]);
      return [Array.from(line.kind), diagonal, line.shape, line.x[40], line.y[40]];
    }}""")
    assert told[0] == told[1] and len(set(told[0])) > 2
    assert told[2:] == [[41], 15, 15]


def test_a_motion_is_the_librarys(page):
    library = json.loads((EXPORTED / "motions.json").read_text())
    assert len(library) > 2
    for own in library:
        cell = page.evaluate(
            f"async (single) => {{ {ENGINE} {PLAIN} return plain(await engine.cell({{ scene: single, motion: true }})); }}",
            own["scene"],
        )
        assert cell["columns"]["outcome"] == own["outcome"]
        assert cell["columns"]["impacts"] == own["impacts"]
        motion, events = cell["motion"], cell["events"]
        rows = dict(zip(motion["t"], zip(motion["phi"], motion["u"], motion["v"], motion["mode"])))
        largest = max(abs(row[1]) for row in own["rows"])
        compared = 0
        for t, phi, u, v, mode in own["rows"]:
            near = min(rows, key=lambda other: abs(other - t))
            if abs(near - t) > 1e-9:
                continue
            compared += 1
            # Both are f32: rounding grows from impact to impact.
            assert abs(rows[near][0] - phi) <= 1e-3 * largest + 1e-9, (own["scene"], t)
            assert abs(rows[near][1] - u) <= 1e-4 and abs(rows[near][2] - v) <= 1e-4
        assert compared > 0.9 * len(motion["t"])
        impacts = [event for event in events if event["what"] in ("impact", "rest")]
        assert len(impacts) == own["impacts"]
        assert len([event for event in events if event["what"] == "uplift"]) == own["uplifts"]
        times = [event["t"] for event in events]
        assert times == sorted(times)
        # Switches lie within a step of the library's own.
        step = max(b - a for a, b in zip(motion["t"], motion["t"][1:]))
        for event, t in zip([event for event in events if event["what"] != "overturned"], own["switches"]):
            assert abs(event["t"] - t) <= step, (own["scene"], event, t)
        assert cell["ground"]["t"][-1] == pytest.approx(cell["t_max"])


PLAIN = """
  const plain = (value) => {
    if (ArrayBuffer.isView(value)) return Array.from(value);
    if (value && typeof value === 'object' && !Array.isArray(value)) {
      return Object.fromEntries(Object.entries(value).map(([key, own]) => [key, plain(own)]));
    }
    return value;
  };
"""


def test_the_command_line_is_the_scenes(page):
    told = page.evaluate(f"""async () => {{ {ENGINE}
      return [
        await engine.command({{ scene, count: [400, 300] }}),
        await engine.command({{ scene: {{ ...scene, shape: 'ricker', omega: '5', t_h: '1:2:log', x: 't_h' }}, count: [9, 8] }}),
      ];
    }}""")
    assert told[0]["command"] == (
        "topple pulse --object=1 --eccentricity=0.2 --t-h=1.75 --t-v=0.75 --omega=0.2:15:400 --a-h=0.1:15:300"
    )
    assert 'omega = "0.2:15:400"' in told[0]["toml"] and "[block]\nobject = 1\n" in told[0]["toml"]
    assert "--pulse=ricker" in told[1]["command"] and "--t-h=1:2:9:log" in told[1]["command"]
    assert told[1]["command"].endswith("--x=t_h --y=a_h")


def test_without_webgpu_stored_maps_are_shown(plain, address):
    page = plain.new_page()
    page.goto(address + "blank")
    told = page.evaluate(f"""async () => {{ {ENGINE}
      const shown = await frames({{ tab: 'a', scene: engine.about.scene, count: [64, 64] }});
      const {{ x, y }} = engine.about.scene;
      const near = {{ ...engine.about.scene, [x]: '5', [y]: '6' }};
      const other = await failed(engine.map({{ tab: 'a', scene: {{ ...scene, eccentricity: '0.3' }} }}, () => {{}}));
      const cell = await engine.cell({{ scene: near, motion: false }});
      const motion = await failed(engine.cell({{ scene: near, motion: true }}));
      const line = await failed(engine.section({{ scene: engine.about.scene, from: [1, 1], to: [2, 2], count: 9 }}));
      const lines = [motion, line].map((error) => error.line);
      return [engine.about.notice, shown.map(({{ shape, note }}) => [shape, note]), shown[0].arrays.kind.length, other, cell.words, lines];
    }}""")
    assert "no WebGPU" in told[0]
    assert len(told[1]) == 1 and "no WebGPU" in told[1][0][1]
    assert told[2] == told[1][0][0][0] * told[1][0][0][1] > 10_000
    assert told[3]["name"] == "EngineError" and "stored" in told[3]["line"]
    assert told[4].startswith("Overturned about the left corner")
    for line, what in zip(told[5], ["the motion of a cell", "a cross-section"]):
        assert "no WebGPU" in line and what in line and "run topple explore" in line


def test_the_exported_page_computes_by_itself(browser, address):
    errors = []
    # A cell is a pixel of the screen: of so few there are still a coarse, a fine and a refined picture.
    context = browser.new_context(viewport={"width": 320, "height": 480}, device_scale_factor=0.62)
    page = context.new_page()
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    page.goto(address)
    page.wait_for_selector("#map[data-stage=coarse], #map[data-stage=fine], #map[data-stage=refined]", timeout=300_000)
    assert "f32" in page.text_content("#status")
    page.wait_for_selector("#map[data-stage=fine], #map[data-stage=refined]", timeout=300_000)
    page.wait_for_selector("#map[data-stage=refined][data-busy=false]", timeout=600_000)
    legend = page.inner_text("#legend")
    assert "full contact" in legend and "0 impacts" in legend
    assert "of 500 probes differed" in page.text_content("#status")
    assert errors == []
    context.close()


def test_the_exported_page_shows_a_stored_map_without_webgpu(plain, address):
    page = plain.new_page()
    page.goto(address)
    page.wait_for_selector("#map[data-stage=stored]")
    status = page.text_content("#status")
    assert "no WebGPU" in status and "stored map, computed by topple" in status and "CPU" in status
    assert "null" not in status and " a second" not in status
    assert "no WebGPU" in page.inner_text("#motion-words") and page.locator("#suggest").is_hidden()
    # What would need an engine cannot be asked for; every stored map has its button.
    page.locator("#map").click(position={"x": 200, "y": 100})
    assert "cell=" not in page.url and page.locator(".problem:visible").count() == 0
    assert page.locator("#sections").evaluate("part => part.inert")
    many = page.evaluate("async () => (await (await fetch('about.json')).json()).stored.length")
    assert page.locator("#notice button").count() == many
    for k in range(many):
        page.locator("#notice button").nth(k).click()
        page.wait_for_selector("#map[data-stage=stored]")
        assert page.locator(".problem:visible").count() == 0
    page.close()


def test_an_exported_page_that_is_opened_as_a_file_says_what_to_do(plain):
    page = plain.new_page()
    page.goto((EXPORTED / "page/index.html").as_uri())
    page.wait_for_timeout(4500)
    assert page.locator("#unopened").is_visible() and "python -m http.server" in page.inner_text("#unopened")
    page.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1280])
def test_axe_finds_nothing_in_an_exported_page(plain, address, axe, scheme, width):
    context = plain.new_context(viewport={"width": width, "height": 800}, color_scheme=scheme, bypass_csp=True)
    page = context.new_page()
    page.goto(address)
    page.wait_for_selector("#map[data-stage=stored]")
    page.evaluate("() => document.querySelectorAll('details').forEach((details) => { details.open = true; })")
    assert axe(page) == []
    context.close()
