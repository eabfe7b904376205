"""How long the page of `topple explore` takes to load, and what it fetches: medians of several visits, each with an empty cache.

    python benches/explore/load.py [VISITS]

It needs playwright, a Chromium (TOPPLE_CHROMIUM), and the command (TOPPLE_COMMAND, else topple). An address in TOPPLE_ADDRESS is measured in
the place of a server that it starts: that of an exported page, for example.
"""

import os
import re
import statistics
import subprocess
import sys

from playwright.sync_api import Browser, sync_playwright

SIZE = {"width": 1280, "height": 800}
# Before any script of the page: the moments at which the map's stage changes.
WATCH = """
try { localStorage.setItem('topple-tour', 'seen'); } catch {}
window.stages = {};
addEventListener('DOMContentLoaded', () => {
  const map = document.getElementById('map');
  new MutationObserver(() => { window.stages[map.dataset.stage] ??= performance.now(); })
    .observe(map, { attributes: true, attributeFilter: ['data-stage'] });
});
"""
TIMES = """() => ({
  'first paint': performance.getEntriesByName('first-contentful-paint')[0].startTime,
  'page parsed': performance.getEntriesByType('navigation')[0].domContentLoadedEventEnd,
  'first map': Math.min(...['coarse', 'fine', 'refined', 'stored'].map((stage) => window.stages[stage] ?? Infinity)),
  'last map': window.stages.refined ?? window.stages.stored,
})"""


def visit(browser: Browser, address: str) -> tuple[dict[str, float], dict[str, int]]:
    """The times of a visit in ms, and the bytes over the wire by the ending of what was fetched."""
    context = browser.new_context(viewport=SIZE)
    page = context.new_page()
    page.add_init_script(WATCH)
    wire = context.new_cdp_session(page)
    wire.send("Network.enable")
    places: dict[str, str] = {}
    sizes: dict[str, int] = {}
    wire.on("Network.requestWillBeSent", lambda of: places.update({of["requestId"]: of["request"]["url"]}))

    def received(of: dict) -> None:
        name = places.get(of["requestId"], "").split("?")[0].rsplit("/", 1)[-1]
        kind = name.rsplit(".", 1)[-1] if "." in name else "page, data"
        sizes[kind] = sizes.get(kind, 0) + int(of["encodedDataLength"])
        sizes["all"] = sizes.get("all", 0) + int(of["encodedDataLength"])
        sizes["requests"] = sizes.get("requests", 0) + 1

    wire.on("Network.loadingFinished", received)
    page.goto(address)
    page.wait_for_selector("#map[data-stage=refined][data-busy=false], #map[data-stage=stored]", timeout=120_000)
    times = page.evaluate(TIMES)
    # The last answers end after the last picture.
    page.wait_for_timeout(1000)
    context.close()
    return times, sizes


def main(visits: int) -> None:
    """Prints the medians."""
    address, process = os.environ.get("TOPPLE_ADDRESS"), None
    if not address:
        command = [os.environ.get("TOPPLE_COMMAND", "topple"), "explore", "--no-open", "--port", "0"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        found = (re.search(r"http://127\.0\.0\.1:\d+/\S+/", line) for line in process.stdout)
        address = next(filter(None, found))[0]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=os.environ.get("TOPPLE_CHROMIUM"), args=["--no-sandbox", "--headless=new"]
        )
        # The first visit also starts the browser's own processes.
        visit(browser, address)
        seen = [visit(browser, address) for _ in range(visits)]
        browser.close()
    if process:
        process.terminate()
        process.wait(timeout=20)
    for name in seen[0][0]:
        times = sorted(times[name] for times, _ in seen)
        print(f"{name:12} {statistics.median(times):6.0f} ms ({times[0]:.0f} to {times[-1]:.0f})")
    for name, size in sorted(seen[-1][1].items(), key=lambda item: -item[1]):
        print(f"{name:12} {size:6} {'' if name == 'requests' else 'bytes'}".rstrip())


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 9)
