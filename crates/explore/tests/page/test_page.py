"""The page of `topple explore` in a browser: what a reader does, and what must not happen meanwhile."""

import os
import random
import re
import statistics

import pytest

MOVES = int(os.environ.get("TOPPLE_MOVES", "300"))
# The aims, in milliseconds, and what a loaded machine of two cores may take.
AIMS = {"coarse": 100, "fine": 400}
GENEROUS = 40
# A window whose map has 513 x 513 cells: those that the times are of.
LARGE = {"viewport": {"width": 1400, "height": 986}}
CELLS = "513 × 513"
# A view of few cells, so that many views are quick.
SMALL = {"viewport": {"width": 360, "height": 640}}


def spread(times):
    times = sorted(times)
    return statistics.median(times), times[int(0.95 * (len(times) - 1))]


def told(what, times, limit):
    median, late = spread(times)
    print(f"\n{what}: median {median:.0f} ms, 95th percentile {late:.0f} ms of {len(times)}")
    assert median < limit


def first(stages, name, since=0.0):
    return next((at - since for at, stage in stages if stage == name and at >= since), None)


def test_the_first_picture_comes_after_the_load(open_page, server):
    """From the moment at which the page asks for it; the time from the address on is told beside it."""
    times = {"coarse": [], "fine": []}
    whole = {"coarse": [], "fine": []}
    for _ in range(9):
        page = open_page(**LARGE)
        page.settle()
        assert CELLS in page.page.text_content("#status"), "the window gives a map of another size"
        asked = [url.removeprefix(server.url) for url in page.requests]
        twice = {name for name in asked if asked.count(name) > 1}
        assert twice <= {"icon.svg"}, "only the icon has two places"
        stages = page.page.evaluate("() => window.stages")
        begun = stages[0][0]
        assert [stage for _, stage in stages] == ["stale", "coarse", "fine", "refined"], "each picture comes once"
        for stage, found in times.items():
            found.append(first(stages, stage) - begun)
            whole[stage].append(first(stages, stage))
        page.page.close()
    for stage, found in times.items():
        told(f"load, {stage}, {CELLS} cells", found, GENEROUS * AIMS[stage])
        told(f"the same from the address on, {stage}", whole[stage], GENEROUS * AIMS[stage])


def test_a_slider_is_answered(open_page):
    page = open_page(**LARGE)
    page.settle()
    assert CELLS in page.page.text_content("#status"), "the window gives a map of another size"
    times = {"coarse": [], "fine": []}
    for k in range(12):
        since = page.page.evaluate("() => { window.stages.length = 0; return performance.now(); }")
        page.slide("eccentricity", 180 + 10 * k)
        page.settle()
        stages = page.page.evaluate("() => window.stages")
        for stage, found in times.items():
            found.append(first(stages, stage, since))
    assert page.page.input_value("#field-eccentricity") == "0.36"
    for stage, found in times.items():
        told(f"slider, {stage}, {CELLS} cells", found, GENEROUS * AIMS[stage])


class Moves:
    """Random moves of a reader."""

    KEYS = ["+", "-", "0", "ArrowLeft", "ArrowUp", "ArrowRight", "ArrowDown", "Shift+ArrowUp", "Control+ArrowLeft"]
    SLIDERS = ["eccentricity", "t_h", "t_v", "psi", "xi_h", "xi_v", "a_v"]

    def __init__(self, page, seed):
        self.page, self.random = page, random.Random(seed)

    def place(self):
        box = self.page.page.locator("#map").bounding_box()
        return (
            box["x"] + box["width"] * self.random.uniform(0.3, 0.9),
            box["y"] + box["height"] * self.random.uniform(0.1, 0.75),
        )

    def wheel(self):
        self.page.page.mouse.move(*self.place())
        self.page.page.mouse.wheel(0, self.random.choice([-240, -120, 120, 240, 480]))

    def drag(self):
        mouse = self.page.page.mouse
        mouse.move(*self.place())
        mouse.down()
        mouse.move(*self.place(), steps=self.random.randint(1, 4))
        mouse.up()

    def key(self):
        self.page.page.locator("#map").press(self.random.choice(self.KEYS))

    def slider(self):
        key = self.random.choice(self.SLIDERS)
        # An axis has no slider.
        if self.page.page.locator(f'.row[data-key="{key}"]:not(.is-axis)').count():
            self.page.slide(key, self.random.randint(0, 400))

    def show(self):
        self.page.page.select_option("#show", self.random.choice(["outcome", "zeta", "max_u", "min_contact"]))

    def button(self):
        self.page.page.locator(self.random.choice(["#zoom-in", "#zoom-out", "#home"])).click()

    def axes(self):
        key, which = self.random.choice([("omega", 0), ("a_h", 1), ("eccentricity", 0), ("t_h", 1)])
        self.page.page.locator(f'.row[data-key="{key}"] .axis').nth(which).evaluate("button => button.click()")

    def back(self):
        # Never before the page itself, to the blank one that the browser began with.
        self.page.page.evaluate("() => navigation.currentEntry.index > 0 && history.back()")

    def one(self):
        kinds = [self.wheel, self.drag, self.key, self.slider, self.show, self.button, self.axes, self.back]
        self.random.choices(kinds, [6, 4, 4, 8, 1, 2, 0.6, 0.3])[0]()
        if self.random.random() < 0.3:
            self.page.page.wait_for_timeout(self.random.choice([0, 10, 40, 120]))


def heap(page, session):
    session.send("HeapProfiler.collectGarbage")
    metrics = session.send("Performance.getMetrics")["metrics"]
    return {metric["name"]: metric["value"] for metric in metrics}


def test_random_moves_leave_no_error_no_leak_and_no_stale_picture(open_page, server):
    page = open_page(**SMALL)
    page.settle()
    session = page.page.context.new_cdp_session(page.page)
    session.send("Performance.enable")
    moves = Moves(page, 22)
    warm = max(20, MOVES // 10)
    often = 50
    start = page.rested().split("#", 1)[1]
    before = None
    for k in range(MOVES):
        moves.one()
        if k == warm:
            page.settle()
            before = heap(page, session)
        if k % often == often - 1:
            # No move leads to a scene that the engine refuses.
            page.settle()
            said = f"move {k}, {page.page.inner_text('#problem')}: {page.page.url}"
            assert page.data()["stage"] not in ("error", "lost"), said
            assert page.errors == []
            # Far from the first scene a view may take a minute.
            page.page.evaluate("(hash) => { location.hash = hash; }", start)
    page.settle()
    after = heap(page, session)
    grown = after["JSHeapUsedSize"] - before["JSHeapUsedSize"]
    print(f"\n{MOVES} moves: heap grown by {grown / 1e6:.1f} MB, nodes {before['Nodes']:.0f} to {after['Nodes']:.0f}")
    assert grown < 12e6
    assert after["Nodes"] < 2 * before["Nodes"] + 500
    address = page.rested()
    page.settle()
    fresh = open_page("#" + address.split("#", 1)[1], **SMALL)
    fresh.settle()
    fresh.rested()
    assert fresh.page.url == address
    assert fresh.page.inner_text("#legend") == page.page.inner_text("#legend")
    page.page.mouse.move(1, 1)
    assert fresh.picture() == page.picture()


def test_a_picture_that_is_not_the_newest_is_never_said_to_be(open_page):
    """The map's stage is stale from the input on until a frame of that very request comes."""
    page = open_page(**SMALL)
    page.settle()
    for place in range(100, 301, 10):
        stage = page.page.locator('.row[data-key="t_h"] input[type=range]').evaluate(
            """(slider, place) => {
              slider.value = place;
              slider.dispatchEvent(new Event('input', { bubbles: true }));
              return document.getElementById('map').dataset.stage;
            }""",
            place,
        )
        assert stage == "stale"
    page.settle()
    assert "t_h=4.55" in page.rested()


def test_back_and_forward(open_page):
    page = open_page()
    page.settle()
    start, picture = page.rested(), page.picture()
    page.page.click("#zoom-in")
    page.settle()
    zoomed = page.rested()
    page.slide("t_h", 300)
    page.settle()
    slid = page.rested()
    assert len({start, zoomed, slid}) == 3
    for expected in (zoomed, start):
        page.page.go_back()
        page.settle()
        assert page.rested() == expected
    assert page.picture() == picture
    page.page.go_forward()
    page.settle()
    assert page.rested() == zoomed


def test_a_drag_is_one_entry_of_the_history(open_page):
    page = open_page()
    page.settle()
    start = page.rested()
    count = page.page.evaluate("() => history.length")
    box = page.page.locator("#map").bounding_box()
    page.page.mouse.move(box["x"] + 300, box["y"] + 150)
    page.page.mouse.down()
    for k in range(20):
        page.page.mouse.move(box["x"] + 300 - 5 * k, box["y"] + 150 + 2 * k)
        page.page.wait_for_timeout(15)
    page.page.mouse.up()
    assert page.rested() != start
    assert page.page.evaluate("() => history.length") == count + 1
    page.settle()


def expect_refused(page, key, selector, text):
    """A text is refused at its field in one line, and the picture is marked as old."""
    page.give(selector, text)
    problem = page.page.locator(f"#problem-{key}")
    problem.wait_for(state="visible", timeout=20_000)
    line = problem.inner_text()
    assert line and "\n" not in line
    assert page.page.locator(selector).get_attribute("aria-invalid") == "true"
    data = page.data()
    assert data["stage"] == "error"
    assert "old" in page.page.locator("#map").get_attribute("class")
    assert page.page.locator("#badge").is_visible()


def test_bad_input_is_told_at_every_field(open_page):
    page = open_page()
    page.settle()
    page.page.evaluate("() => document.querySelectorAll('details').forEach((details) => { details.open = true; })")
    keys = page.page.locator(".row:visible").evaluate_all("rows => rows.map((row) => row.dataset.key)")
    assert len(keys) > 15
    for key in keys:
        is_axis = page.page.locator(f'.row[data-key="{key}"].is-axis').count()
        selector = f'.row[data-key="{key}"] .end >> nth=0' if is_axis else f"#field-{key}"
        before = page.page.input_value(selector)
        for text in ("nonsense", "1e999"):
            expect_refused(page, key, selector, text)
        page.give(selector, before)
        page.settle()
        assert page.data()["stage"] != "error", key
        assert page.page.locator(f"#problem-{key}").is_hidden()


def test_a_lost_server_is_told_and_tried_again(open_page):
    page = open_page()
    page.settle()
    page.page.route("**/map", lambda route: route.abort())
    page.slide("t_h", 150)
    banner = page.page.locator("#banner")
    banner.wait_for(state="visible")
    assert page.data()["stage"] == "lost"
    # Nothing blocks: the view still moves.
    address = page.rested()
    page.page.click("#zoom-in")
    assert page.rested() != address
    page.page.unroute("**/map")
    page.page.click("#retry")
    page.settle()
    assert banner.is_hidden()
    page.errors.clear()


def test_a_server_that_ended_is_told(open_page, own_server):
    page = open_page(url=own_server.url)
    page.settle()
    own_server.stop()
    page.slide("t_h", 150)
    page.page.locator("#banner").wait_for(state="visible")
    assert "server" in page.page.inner_text("#banner-text")
    page.errors.clear()


def test_two_tabs_do_not_end_each_other(open_page):
    one, two = open_page(**SMALL), open_page(**SMALL)
    for k in range(10):
        one.slide("t_h", 100 + 10 * k)
        two.slide("t_v", 100 + 10 * k)
    one.settle()
    two.settle()
    assert one.rested() != two.rested()
    for page in (one, two):
        fresh = open_page("#" + page.page.url.split("#", 1)[1], **SMALL)
        fresh.settle()
        assert fresh.picture() == page.picture()


def test_a_cell_opens_and_its_time_is_linked(open_page):
    page = open_page()
    page.settle()
    page.page.click("#suggest")
    page.page.locator(".cell .histories").wait_for()
    page.page.wait_for_timeout(300)
    page.page.click("#to-start")
    seen = []
    for _ in range(3):
        page.page.click("#step")
        seen.append(page.page.inner_text("#event"))
    assert "uplift" in seen[0]
    assert any("impact" in text for text in seen)
    page.page.locator("#map").click(modifiers=["Shift"], position={"x": 300, "y": 200})
    page.page.locator(".cell >> nth=1").wait_for()
    assert "cell2=" in page.rested()
    page.page.locator(".cell .close >> nth=1").click()
    assert "cell2=" not in page.rested()


def test_a_line_is_drawn_and_told(open_page):
    page = open_page()
    page.settle()
    page.page.click("#tool")
    box = page.page.locator("#map").bounding_box()
    page.page.mouse.move(box["x"] + 120, box["y"] + 60)
    page.page.mouse.down()
    page.page.mouse.move(box["x"] + 400, box["y"] + 250, steps=6)
    page.page.mouse.up()
    page.page.locator("#section-ends >> text=from").wait_for()
    assert "line=" in page.rested()
    assert "stretches" in page.page.get_attribute("#section-picture", "aria-label")
    page.page.click("#section-close")
    assert "line=" not in page.rested()


def test_a_line_of_earlier_numbers_is_marked(open_page):
    page = open_page("#object=1&eccentricity=0.2&t_h=1.75&t_v=0.75&omega=0.2:15&a_h=0.1:15&x=omega&y=a_h&line=1,1,14,14")
    page.settle()
    strip = page.page.locator("#section")
    page.page.locator("#section-ends >> text=from").wait_for()
    page.page.wait_for_selector("#section:not(.old)")
    held = []
    page.page.route("**/section", lambda route: held.append(route))
    page.slide("t_h", 150)
    page.page.wait_for_selector("#section.old")
    page.settle()
    assert "old" in strip.get_attribute("class")
    while held:
        held.pop().continue_()
        page.page.wait_for_timeout(300)
    page.page.wait_for_selector("#section:not(.old)")


def test_how_far_a_slow_picture_is(open_page):
    """A stiff base needs many steps: the status line tells how many cells are done."""
    page = open_page("#object=1&eccentricity=0.2&t_h=1.75&t_v=0.02&t_max=60&omega=0.2:15&a_h=0.1:15&x=omega&y=a_h&precision=f64")
    page.page.wait_for_function(
        "() => /(coarse|fine|refined) picture: \\d+ % of [\\d\u202f]+ cells/.test(document.getElementById('status').textContent)",
        timeout=120_000,
    )


def test_whole_numbers_are_shown_one_by_one(open_page):
    """An axis of whole numbers has its own ends, not those of a coarser picture; the other axis has as many cells as ever."""
    page = open_page("#object=1&t_h=1.75&t_v=0.75&omega=4&a_h=0.1:9&bouc_wen_n=1:4&x=bouc_wen_n&y=a_h&t_max=3", **SMALL)
    page.settle()
    assert "refined" not in page.data()["stage"]
    shape = page.page.text_content("#status")
    assert "coarse, 4 ×" in shape
    page.page.click("#zoom-in")
    page.settle()
    assert "bouc_wen_n=2:3" in page.rested() or "bouc_wen_n=1:3" in page.page.url or "bouc_wen_n=2:4" in page.page.url
    page.errors.clear()


def test_a_wide_view_does_not_round_its_end_to_zero(open_page):
    """Omega has no largest value, and zero is none of its values: to the digits of a span of thousands the least is 0."""
    page = open_page("#object=1&t_h=1.75&t_v=0.75&omega=0.04:900&a_h=0.1:9&x=omega&y=a_h&t_max=3", **SMALL)
    page.settle()
    for _ in range(3):
        page.page.click("#zoom-out")
        page.settle()
        assert page.data()["stage"] not in ("error", "lost"), page.page.inner_text("#problem")
    low, high = re.search(r"omega=([^:&]+):([^:&]+)", page.rested()).groups()
    assert 0 < float(low) < 0.1 and float(high) > 1000
    # A cell at the left edge has a frequency, too.
    picture = page.page.locator("#marks").bounding_box()
    for away in range(40, 70):
        page.page.mouse.click(picture["x"] + away, picture["y"] + picture["height"] / 2)
        if "cell=" in page.rested():
            break
    assert "cell=" in page.page.url and "cell=0," not in page.page.url
    page.settle()
    assert page.data()["stage"] not in ("error", "lost"), page.page.inner_text("#problem")


ODD = ["nonsense", "NaN", "1e999", "1:2", "0x10", "٣", "5\u200b", "9" * 2000, "<b>1</b>", "1,5", "1 2", "--"]


def test_odd_texts_are_told_in_one_short_line(open_page):
    page = open_page(**SMALL)
    page.settle()
    for text in ODD:
        expect_refused(page, "t_h", "#field-t_h", text)
        line = page.page.locator("#problem-t_h").inner_text()
        assert line.startswith("t_h: ") and ("; give" in line or "must" in line) and len(line) < 250, line
    page.give("#field-t_h", "1.75")
    page.settle()
    # Of the address only what a scene has is taken, and a range that is none is told.
    for state, key in [("omega=15:0.1", "omega"), ("omega=1:1", "omega"), ("omega=", ""), ("x=nothing", "x"), ("psi=1e999", "psi")]:
        base = "object=1&t_h=1.75&t_v=0.75&omega=0.2:15&a_h=0.1:15&x=omega&y=a_h"
        name = state.split("=")[0]
        pairs = [pair for pair in base.split("&") if not pair.startswith(f"{name}=")]
        other = open_page("#" + "&".join([*pairs, state, "cell=NaN,1", "line=1,2", "foo=1", "show=nothing", "%zz=1"]), **SMALL)
        other.page.wait_for_selector("#map[data-stage=error]")
        line = other.page.inner_text("#problem")
        assert line.strip() and "\n" not in line.strip() and len(line) < 250, (state, line)
        assert not key or key in line, (state, line)


def test_by_keyboard_alone(open_page):
    page = open_page()
    page.settle()
    keyboard = page.page.keyboard
    for _ in range(40):
        keyboard.press("Tab")
        if page.page.evaluate("() => document.activeElement.id") == "map":
            break
    assert page.page.evaluate("() => document.activeElement.id") == "map"
    start = page.rested()
    keyboard.press("+")
    page.settle()
    assert page.rested() != start
    keyboard.press("0")
    page.settle()
    assert page.rested() == start
    for key in ("Shift+ArrowUp", "Shift+ArrowRight", "Control+ArrowRight"):
        keyboard.press(key)
    page.page.wait_for_timeout(400)
    assert "Ω" in page.page.inner_text("#readout")
    assert "Ω" in page.page.text_content("#live")
    keyboard.press("Enter")
    page.page.locator(".cell").wait_for()
    assert "cell=" in page.rested()
    keyboard.press("l")
    for _ in range(8):
        keyboard.press("Shift+ArrowLeft")
    keyboard.press("l")
    assert "line=" in page.rested()
    keyboard.press("Escape")
    address = page.rested()
    assert "cell=" not in address and "line=" not in address


def test_what_the_system_says_of_motion_is_kept(open_page):
    page = open_page(reduced_motion="reduce")
    page.settle()
    page.page.click("#suggest")
    page.page.locator(".cell").wait_for()
    page.page.wait_for_timeout(500)
    assert page.page.locator("#play").is_hidden()
    assert page.page.inner_text("#time") == "t = 0.00 s"
    page.page.click("#step")
    assert page.page.inner_text("#time") != "t = 0.00 s"


LUMINANCE = """
() => {
  const style = getComputedStyle(document.documentElement);
  const canvas = document.createElement('canvas').getContext('2d');
  const luminance = (name) => {
    canvas.fillStyle = style.getPropertyValue(name);
    canvas.fillRect(0, 0, 1, 1);
    const linear = [...canvas.getImageData(0, 0, 1, 1).data].slice(0, 3)
      .map((part) => part / 255)
      .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  };
  const contrast = (a, b) => {
    const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
    return (high + 0.05) / (low + 0.05);
  };
  const text = ['--ink', '--soft', '--bad', '--accent'].flatMap((name) => ['--paper', '--surface'].map((on) => [name, on, contrast(name, on), 4.5]));
  text.push(['--on-accent', '--accent', contrast('--on-accent', '--accent'), 4.5], ['--bad', '--bad-paper', contrast('--bad', '--bad-paper'), 4.5]);
  for (const on of ['--paper', '--surface']) text.push(['--edge', on, contrast('--edge', on), 3], ['--curve', on, contrast('--curve', on), 3]);
  return text;
}
"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_contrast_is_enough(open_page, scheme):
    """WCAG 2.2, AA: 4.5 for text, 3 for borders of controls and for curves."""
    page = open_page(color_scheme=scheme)
    for ink, paper, contrast, least in page.page.evaluate(LUMINANCE):
        assert contrast >= least, f"{scheme}: {ink} on {paper}"
    page.settle()


def test_every_control_has_a_name(open_page):
    page = open_page()
    page.settle()
    nameless = page.page.evaluate(
        """() => [...document.querySelectorAll('button, input, select, canvas[role], [role=application]')]
          .filter((control) => !control.getAttribute('aria-label') && !control.labels?.length && !control.textContent.trim())
          .map((control) => control.outerHTML)"""
    )
    assert nameless == []


@pytest.mark.parametrize("width, height", [(320, 640), (1280, 800), (3840, 2160)])
def test_the_page_fits(open_page, width, height):
    page = open_page(viewport={"width": width, "height": height})
    page.settle()
    page.page.click("#suggest")
    page.page.locator(".cell").wait_for()
    wide = page.page.evaluate("() => document.documentElement.scrollWidth")
    assert wide <= width
    beyond = page.page.evaluate(
        """() => [...document.querySelectorAll('.layout > section, .row, .toolbar, .clock')]
          .filter((part) => part.scrollWidth > part.clientWidth + 1).map((part) => part.className)"""
    )
    assert beyond == []
    page.settle()


def test_the_page_asks_nobody_else(open_page, server):
    page = open_page()
    page.settle()
    page.page.click("#copy")
    page.page.locator("#dialog pre >> nth=0").wait_for()
    assert "topple pulse" in page.page.inner_text("#dialog pre >> nth=0")
    strangers = [url for url in page.requests if not url.startswith((server.url, "blob:", "data:"))]
    assert strangers == []


@pytest.mark.parametrize("kind", ["PNG", "SVG", "NPZ", "TOML"])
def test_what_is_in_view_is_saved(open_page, kind):
    page = open_page(**SMALL)
    page.settle()
    page.page.click("#save")
    with page.page.expect_download() as download:
        page.page.locator(f"#dialog button >> text={kind},").click()
    head = download.value.path().read_bytes()[:8]
    begins = {"PNG": b"\x89PNG", "SVG": b"<", "NPZ": b"PK", "TOML": b"["}[kind]
    assert head.startswith(begins)


def test_a_record_shakes_the_base(open_page, tmp_path):
    steps = "".join(f"{0.01 * k:.2f} {2.0 if k // 40 % 2 else -2.0}\n" for k in range(400))
    record = tmp_path / "shaking.txt"
    record.write_text(steps)
    page = open_page(**SMALL)
    page.settle()
    page.page.locator("#source input[type=file]").set_input_files(record)
    units = page.page.locator("#need-units")
    units.wait_for()
    units.select_option("m/s2")
    page.page.locator("#dialog button >> text=Shake").click()
    page.settle()
    address = page.rested()
    assert "horizontal=shaking.txt" in address and "x=t_h" in address and "omega" not in address
    page.page.locator("#excitation [data-key=pulse]").click()
    page.settle()
    assert "omega=" in page.rested() and "horizontal" not in page.page.url


def test_files_arrive_whole_under_their_names(open_page, tmp_path):
    files = [tmp_path / name for name in ("list.csv", "ä 'b'.txt", "c.txt")]
    files[0].write_text(f"id,horizontal,dt,units\none,{files[1].name},0.01,g\ntwo,{files[2].name},0.01,g\n", encoding="utf-8")
    for number, file in enumerate(files[1:]):
        file.write_text("".join(f"{(0.1 + 0.1 * number) * (-1) ** (k // 40)}\n" for k in range(400 + number)))
    page = open_page(**SMALL)
    page.settle()
    page.page.locator("#source input[type=file]").set_input_files(files)
    page.page.locator("#source >> text=2 motions").wait_for()
