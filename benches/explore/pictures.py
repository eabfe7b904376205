"""Takes the pictures of docs/explore.md, a screenshot and a recording as GIF, and makes the PNG of the page's icon.

    python benches/explore/pictures.py docs

It needs playwright and pillow, a Chromium (TOPPLE_CHROMIUM), and the command (TOPPLE_COMMAND, else topple).
"""

import io
import os
import subprocess
import sys
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

SIZE = {"width": 1280, "height": 800}
# A cell that rocks through several impacts, in shares of the map.
CELL = (0.62, 0.28)
# The icon of the page, and the size of its PNG, that of an iPhone's home screen.
PAGE_ICON = Path(__file__).parents[2] / "crates/explore/src/page/icon.svg"
ICON = 180
# The tour of a first visit would hide what the pictures show.
NO_TOUR = "localStorage.setItem('topple-tour', 'seen')"
# Time between two pictures of the recording, ms.
PACE = 120


def settled(page: Page) -> None:
    """Waits for the last picture of a view."""
    # The page's policy allows no function that is made of a text.
    page.wait_for_selector('#map[data-busy="false"]', timeout=60_000)


class Recording:
    """Pictures in a row."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.pictures: list[Image.Image] = []

    def take(self, count: int = 1) -> None:
        for _ in range(count):
            picture = Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")
            self.pictures.append(picture.resize((960, 600), Image.Resampling.LANCZOS))
            self.page.wait_for_timeout(PACE)

    def write(self, place: Path) -> None:
        # One palette for all, so that what does not move is the same in each.
        palette = self.pictures[-1].quantize(colors=128, dither=Image.Dither.NONE)
        drawn = [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in self.pictures]
        drawn[0].save(place, save_all=True, append_images=drawn[1:], duration=PACE, loop=0, optimize=True)


def at(page: Page, share: tuple[float, float]) -> tuple[float, float]:
    box = page.locator("#map").bounding_box()
    assert box is not None
    return box["x"] + share[0] * box["width"], box["y"] + share[1] * box["height"]


def take(address: str, folder: Path) -> None:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=os.environ.get("TOPPLE_CHROMIUM", "/usr/bin/chromium"), args=["--no-sandbox"]
        )
        page = browser.new_page(viewport=SIZE, color_scheme="light")
        page.add_init_script(NO_TOUR)
        page.goto(address)
        settled(page)
        recording = Recording(page)
        recording.take(4)
        page.mouse.move(*at(page, CELL))
        for _ in range(8):
            page.mouse.wheel(0, -120)
            recording.take()
        settled(page)
        recording.take(3)
        page.mouse.click(*at(page, (0.5, 0.45)))
        page.wait_for_selector("#players:not([hidden])")
        settled(page)
        recording.take(24)
        recording.write(folder / "explore.gif")
        page.screenshot(path=folder / "explore.png")
        dark = browser.new_page(viewport=SIZE, color_scheme="dark")
        dark.add_init_script(NO_TOUR)
        dark.goto(page.url)
        dark.wait_for_selector("#players:not([hidden])")
        settled(dark)
        dark.screenshot(path=folder / "explore-dark.png")
        # For browsers whose tabs and home screens show no SVG.
        icon = browser.new_page(viewport={"width": ICON, "height": ICON})
        icon.set_content(f"<style>* {{ margin: 0 }} svg {{ display: block }}</style>{PAGE_ICON.read_text()}")
        icon.screenshot(path=folder / "icon.png")
        browser.close()


def main() -> None:
    folder = Path(sys.argv[1])
    command = [os.environ.get("TOPPLE_COMMAND", "topple"), "explore", "--no-open"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        try:
            take(server.stdout.readline().split()[-1], folder)
        finally:
            server.terminate()


main()
