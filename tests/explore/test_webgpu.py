"""The engine of the exported page in Chromium, on SwiftShader's WebGPU, against the library.

`cargo test --test exported` writes what the library has; `python -m pytest tests/explore/test_webgpu.py` compares.
"""

import functools
import http.server
import json
import os
import pathlib
import threading

import pytest

playwright = pytest.importorskip("playwright.sync_api")

ROOT = pathlib.Path(__file__).parents[2]
MODULES = ROOT / "src/explore/page/gpu"
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
    """Serves the modules under /gpu/ and what the library wrote beside them."""

    extensions_map = {".js": "text/javascript", ".html": "text/html", ".json": "application/json"}

    def translate_path(self, path):
        path = path.split("?")[0]
        if path.startswith("/gpu/"):
            return str(MODULES / path[5:])
        return str(EXPORTED / path.lstrip("/"))

    def do_GET(self):
        if self.path == "/":
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
def browser():
    with playwright.sync_playwright() as p:
        own = p.chromium.launch(executable_path=CHROMIUM, args=SOFTWARE)
        yield own
        own.close()


@pytest.fixture(scope="module")
def page(browser, address):
    page = browser.new_page()
    page.set_default_timeout(120_000)
    page.goto(address)
    page.evaluate(LIBRARY)
    return page


LIBRARY = """async () => {
  const of = async (name) => (await fetch(name)).json();
  const { learn } = await import('/gpu/known.js');
  learn(await of('/model.json'));
  const { Device } = await import('/gpu/device.js');
  const device = await Device.open(await (await fetch('/sweep.wgsl')).text());
  window.engine = { of, device };
}"""

# Each part of a scene: words that differ from the library's, and the first outcomes that do.
COMPARE = """async ([file, spoiled]) => {
  const { of, device } = window.engine;
  const { known } = await import('/gpu/known.js');
  const { sceneOf } = await import('/gpu/scene.js');
  const { partsOf } = await import('/gpu/plan.js');
  const { CellTables, stepWords } = await import('/gpu/tables.js');
  const { tileOf } = await import('/gpu/tile.js');
  const { windowAround } = await import('/gpu/grid.js');
  const { LoadedTile } = await import('/gpu/chunks.js');
  const { samplesOf, sweepCells } = await import('/gpu/sweep.js');
  const { Pace } = await import('/gpu/pace.js');
  const library = await of(file);
  if (spoiled) known.gravity *= 1 + 1e-7;
  try {
    const scene = sceneOf(library.scene, library.count);
    const { grid } = scene;
    const parts = partsOf(scene, grid, null);
    const differ = (words, other) => {
      if (words.length !== other.length) return -1;
      return words.reduce((sum, word, k) => sum + (word !== other[k]), 0);
    };
    const reals = (entries) => new Uint32Array(Float32Array.from(entries.flat()).buffer);
    const told = { parts: [parts.length, library.parts.length], words: {}, cells: 0 };
    const add = (name, count) => { told.words[name] = (told.words[name] ?? 0) + count; };
    for (const [k, part] of parts.entries()) {
      const { tables, cells } = library.parts[k];
      const own = new CellTables(part.plan, grid, windowAround(grid, Math.min(...cells), Math.max(...cells)));
      add('numbers of cells', differ(part.cells ?? cells, cells));
      add('bodies', differ(reals(own.bodies.entries.map((body) => body.model)), tables.bodies));
      for (const name of ['horizontal', 'vertical', 'drive']) add(name, differ(reals(own[name].entries), tables[name]));
      if (tables.clocks !== null) add('clocks', own.ownClocks ? -1 : differ(stepWords(own.clocks.entries), tables.clocks));
      // As the device makes them of the tables.
      const list = part.cells === null ? null : cells;
      const tile = tileOf(own, { first: 0, count: cells.length, list }, 2 * cells.length);
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
    told.cells = outcomes.length;
    told.differences = [];
    told.kinds = {};
    told.worst = {};
    for (const { cells, outcomes: theirs } of library.parts) {
      cells.forEach((cell, k) => {
        const mine = outcomes[cell];
        told.kinds[mine.outcome] = (told.kinds[mine.outcome] ?? 0) + 1;
        for (const [name, value] of Object.entries(theirs?.[k] ?? {})) {
          if (typeof value === 'number') {
            const apart = Math.abs(mine[name] - value) / Math.max(Math.abs(value), 1e-12);
            told.worst[name] = Math.max(told.worst[name] ?? 0, apart);
          }
          if (['outcome', 'status', 'impacts', 'uplifts'].includes(name) && mine[name] !== value) {
            told.differences.push([cell, name, mine[name], value]);
          }
        }
      });
    }
    return told;
  } finally {
    if (spoiled) known.gravity /= 1 + 1e-7;
  }
}"""


@pytest.mark.parametrize("scene", SCENES, ids=NAMES)
def test_a_scene_has_the_librarys_words_and_outcomes(page, scene):
    told = page.evaluate(COMPARE, [f"/{scene.name}", False])
    print(json.dumps(told))
    assert told["parts"][0] == told["parts"][1]
    assert all(count == 0 for count in told["words"].values()), told["words"]
    assert told["differences"] == []


def test_a_mistake_in_a_number_shows(page):
    told = page.evaluate(COMPARE, [f"/{SCENES[0].name}", True])
    assert told["words"]["bodies"] > 0
