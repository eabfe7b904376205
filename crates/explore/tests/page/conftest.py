"""A server of `topple explore`, a browser, and a page whose errors fail its test."""

import importlib.util
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[4]
COMMAND = os.environ.get("TOPPLE_COMMAND", str(ROOT / "target/release/topple"))
BROWSERS = ["chromium", "chromium-browser", "google-chrome"]
# Records when the map's stage changes, for the tests alone: the page knows nothing of it. The tour was seen.
WATCH = """
try { if (!location.hash.includes('tour')) localStorage.setItem('topple-tour', 'seen'); } catch {}
addEventListener('DOMContentLoaded', () => {
  window.stages = [];
  const map = document.getElementById('map');
  new MutationObserver(() => window.stages.push([performance.now(), map.dataset.stage]))
    .observe(map, { attributes: true, attributeFilter: ['data-stage'] });
});
"""


class Server:
    """A running server; `url` is its page's address."""

    def __init__(self):
        command = [COMMAND, "explore", "--no-open", "--port", "0"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        self.url = None
        for line in self.process.stdout:
            found = re.search(r"http://127\.0\.0\.1:\d+/\S+/", line)
            if found:
                self.url = found[0]
                break
        assert self.url, "the server tells no address"

    def stop(self):
        self.process.terminate()
        self.process.wait(timeout=20)
        self.process.stdout.close()


@pytest.fixture(scope="session")
def server():
    running = Server()
    yield running
    running.stop()


@pytest.fixture
def own_server():
    """A server of one test, which may end it."""
    running = Server()
    yield running
    if running.process.poll() is None:
        running.stop()


@pytest.fixture(scope="session")
def driver():
    """Playwright, of which there is one a run."""
    with pytest.importorskip("playwright.sync_api").sync_playwright() as playwright:
        yield playwright


@pytest.fixture(scope="session")
def browser(driver):
    path = os.environ.get("TOPPLE_CHROMIUM") or next(filter(None, map(shutil.which, BROWSERS)), None)
    if not path:
        pytest.skip("no Chromium: give its path as TOPPLE_CHROMIUM")
    launched = driver.chromium.launch(executable_path=path, args=["--no-sandbox", "--headless=new"])
    yield launched
    launched.close()


# What axe finds of a page, each with the first elements that it is of.
FOUND = """async () => (await axe.run()).violations.map(
  ({ id, nodes }) => [id, nodes.slice(0, 4).map((node) => node.html.slice(0, 160))])"""


@pytest.fixture(scope="session")
def axe():
    """What axe-core finds of a page, which must not forbid scripts of others: of the Python package that carries it."""
    package = importlib.util.find_spec("axe_playwright_python")
    if package is None:
        pytest.skip("no axe-core: pip install axe-playwright-python")
    script = Path(package.submodule_search_locations[0]) / "axe.min.js"

    def found(page):
        page.add_script_tag(path=script)
        return page.evaluate(FOUND)

    return found


class Page:
    """A page of the explorer with the errors of its console."""

    def __init__(self, context, url):
        self.page = context.new_page()
        self.errors = []
        self.page.on("console", self.hear)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.add_init_script(WATCH)
        self.requests = []
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(url)

    def hear(self, message):
        if message.type == "error":
            self.errors.append(message.text)

    def data(self):
        """The data attributes of the map."""
        return self.page.locator("#map").evaluate("map => ({ ...map.dataset })")

    def settle(self, timeout=300_000):
        """Waits for the last picture of the newest input."""
        # One picture of the screen: what the page still has to ask is asked.
        self.page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        self.page.wait_for_selector(
            '#map[data-busy="false"]:not([data-stage="stale"]):not([data-stage=""])', timeout=timeout
        )

    def picture(self):
        """The pixels of the map, when hatches and dots are drawn."""
        self.page.wait_for_timeout(400)
        return self.page.locator("#picture").evaluate("canvas => canvas.toDataURL()")

    def rested(self):
        """Waits until the state is an entry of the history; its address."""
        self.page.wait_for_timeout(600)
        return self.page.url

    def slide(self, key, place):
        """Moves a slider to one of its 400 places, as a hand does."""
        self.page.locator(f'.row[data-key="{key}"] input[type=range]').evaluate(
            "(slider, place) => { slider.value = place; slider.dispatchEvent(new Event('input', { bubbles: true })); }",
            place,
        )

    def give(self, selector, text):
        """Types into a field and gives it."""
        field = self.page.locator(selector)
        field.fill(text)
        field.press("Enter")


@pytest.fixture
def open_page(browser, server):
    """Opens pages; none of them may have had an error at the end, but those that the test takes out."""
    contexts, pages = [], []

    def opened(state="", url=None, **options):
        options = {"viewport": {"width": 1280, "height": 800}, **options}
        contexts.append(browser.new_context(**options))
        pages.append(Page(contexts[-1], (url or server.url) + state))
        return pages[-1]

    yield opened
    errors = [error for page in pages for error in page.errors]
    for context in contexts:
        context.close()
    assert errors == []
