"""The page in a real browser: Chromium, on loopback."""

import json
import re
import tomllib
from urllib.parse import urlsplit

import pytest

from antinode import load_case, solve_modes
from antinode.examples import write_example

pytest.importorskip("nicegui", reason="nicegui is not installed (extra web)")

from antinode.app.source import read_example
from app_browser import Tab, serving

SLIDERS = ("speed", "cavitation number", "cavitator angle", "thrust", "fin position", "burn")


def keyboard(tab, label, key, times=1):
    """Move a slider by keys."""
    slider = tab.page.locator(f".an-slider[aria-label^='{label}'] .q-slider__track-container")
    slider.focus()
    for _ in range(times):
        slider.press(key)


def assert_clean(tab, address):
    """Nothing was complained of, and nothing asked for beyond the server."""
    assert tab.errors == []
    here = urlsplit(address).netloc
    outside = [u for u in tab.requests if urlsplit(u).netloc not in (here, "")]
    assert outside == []
    assert len(tab.requests) > 10


def test_the_first_view_shows_the_starter(tab, address):
    assert tab.frequency(1) == "3.76703"
    assert tab.frequency(6) == "58.1217"
    text = tab.page.locator(".an-at-vehicle").inner_html()
    for force in ("cavitator drag 13 kN", "planing lift 8.22 kN", "thrust 50 kN", "weight"):
        assert force in text
    assert_clean(tab, address)


@pytest.mark.parametrize(("width", "height"), [(1280, 800), (1920, 1080)])
def test_nothing_overlaps_and_nothing_scrolls(context, address, width, height):
    tab = Tab(context, address, width=width, height=height)
    boxes = [b.bounding_box() for b in tab.page.locator(".an-card, .an-section").all()]
    assert len(boxes) == 11
    for k, a in enumerate(boxes):
        assert a["x"] >= 0
        assert a["y"] >= 0
        assert a["x"] + a["width"] <= width
        if a["x"] > 300:  # the side may be longer: it scrolls by itself
            assert a["y"] + a["height"] <= height
        for b in boxes[k + 1 :]:
            apart = (
                a["x"] + a["width"] <= b["x"]
                or b["x"] + b["width"] <= a["x"]
                or a["y"] + a["height"] <= b["y"]
                or b["y"] + b["height"] <= a["y"]
            )
            assert apart, (a, b)
    scroll = "document.documentElement.scrollHeight - window.innerHeight"
    assert tab.page.evaluate(scroll) <= 0
    fonts = tab.page.evaluate(
        "[...new Set([...document.querySelectorAll('.an-app *:not(.q-icon)')]"
        ".map(e => getComputedStyle(e).fontFamily.split(',')[0]))]"
    )
    assert fonts == ["Roboto"]
    tab.page.close()


@pytest.mark.parametrize("label", SLIDERS)
def test_each_slider_moves_every_picture(tab, address, label):
    tab.page.evaluate(
        """() => {
            window.seen = new Set();
            window.updates = 0; // of elements: each draws the whole page anew
            window.socket.on("update", () => window.updates++);
            for (const [name, view] of Object.entries(window.antinode.views)) {
                const show = view.show;
                view.show = (data) => { window.seen.add(name); show.call(view, data); };
            }
        }"""
    )
    before = tab.frequency(1)
    keyboard(tab, label, "ArrowRight", 6)
    tab.changed(before)
    seen = set(tab.page.evaluate("[...window.seen]"))
    wanted = {"forces", "modes", "frequencies", "characteristic", "body", "curve", "vehicle"}
    assert wanted <= seen
    assert tab.page.evaluate("window.updates") <= 1  # that Undo is possible now
    assert_clean(tab, address)


def test_a_slider_by_the_mouse_and_the_link_it_leaves(tab, context, address):
    track = tab.page.locator(".an-slider[aria-label^='thrust']").bounding_box()
    before = tab.frequency(1)
    y = track["y"] + track["height"] / 2
    tab.page.mouse.move(track["x"] + track["width"] / 2, y)
    tab.page.mouse.down()
    for part in (0.6, 0.7, 0.8):
        tab.page.mouse.move(track["x"] + part * track["width"], y)
    tab.page.mouse.up()
    tab.changed(before)
    tab.page.wait_for_function(
        """() => {
            const slider = document.querySelector(".an-slider[aria-label^='thrust']");
            const set = JSON.parse(new URLSearchParams(location.search).get("set") ?? "{}");
            return set["condition.thrust"] === 1000 * slider.getAttribute("aria-valuenow");
        }"""
    )
    tab.settle()
    again = Tab(context, tab.page.url)
    assert again.frequency(1) == tab.frequency(1)
    again.page.close()
    tab.page.get_by_role("button", name="Undo").click()
    tab.page.wait_for_function("!location.search.includes('thrust')")
    tab.wait_for_frequency(before)


def test_a_field_takes_units_and_says_what_is_wrong(tab, address):
    tab.set_field("speed [m/s]", "360 km/h")
    tab.wait_for_frequency("3.76675")
    field = tab.page.get_by_label("speed [m/s]").and_(tab.page.locator("input"))
    tab.page.wait_for_function("document.querySelector('.an-input input').value === '100'")
    tab.set_field("speed [m/s]", "50 kg")
    message = tab.page.locator(".an-message:visible")
    message.wait_for()
    assert "condition.speed is '50 kg'; 'kg' is no unit of m/s" in message.inner_text()
    tab.page.wait_for_selector(".an-main.an-stale")
    tab.settle()
    assert field.get_attribute("aria-invalid") == "true"
    assert tab.frequency(1) == "3.76675"  # the last good result stays
    tab.page.get_by_role("button", name="Undo").click()
    tab.page.wait_for_selector(".an-main:not(.an-stale)")
    message.wait_for(state="hidden")
    assert_clean(tab, address)


def test_dropped_files(tab, address, tmp_path):
    write_example("paper", tmp_path / "paper")
    write_example("tower", tmp_path / "tower")
    bad = tmp_path / "bad.toml"
    bad.write_text("[vehicle]\nname = 3\n", encoding="utf-8")
    drop(tab, [bad])
    toast = tab.page.locator(".an-toast")
    toast.wait_for()
    assert "bad.toml: vehicle.name is 3" in toast.inner_text()
    assert tab.frequency(1) == "3.76703"  # nothing has changed
    toast.get_by_text("Close").click()
    toast.wait_for(state="detached")
    drop(tab, [tmp_path / "paper" / "case.toml"])
    tab.page.get_by_text("was not dropped with it").wait_for()
    toast.get_by_text("Close").click()
    toast.wait_for(state="detached")
    drop(tab, sorted((tmp_path / "paper").iterdir()))
    tab.page.get_by_text("paper vehicle, reconstructed").wait_for()
    tab.settle()
    exact = solve_modes(load_case(tmp_path / "paper" / "case.toml")).mode("bending", 1)
    assert float(tab.frequency(1)) == pytest.approx(exact.frequency_hz, rel=1e-5)
    drop(tab, [tmp_path / "tower" / "beam.toml"])
    tab.page.get_by_text("tower with a top mass").wait_for()
    tab.settle()
    assert tab.page.locator(".an-at-vehicle").count() == 0
    assert tab.frequency(1).startswith("0.338")
    assert_clean(tab, address)


def drop(tab, paths):
    """Drop files on the page."""
    tab.drop([{"name": p.name, "text": p.read_text(encoding="utf-8")} for p in paths])


def test_two_sessions_do_not_touch_each_other(context, address):
    one, two = Tab(context, address), Tab(context, address)
    keyboard(one, "thrust", "ArrowRight", 20)
    keyboard(two, "thrust", "ArrowLeft", 20)
    for tab in (one, two):
        tab.page.wait_for_function("location.search.includes('thrust')")
        tab.changed("3.76703")
    assert float(one.frequency(1)) < 3.76703 < float(two.frequency(1))
    for tab in (one, two):
        assert_clean(tab, address)
        tab.page.close()


def test_modes_units_baseline_and_band(tab, address):
    tab.page.get_by_role("button", name="mode 4").click()
    tab.page.get_by_label("Let the modes vibrate").click()
    tab.page.get_by_role("button", name="Longitudinal").click()
    tab.page.wait_for_function("document.querySelector('.an-hz:not(th)')?.innerText === '56.557'")
    tab.page.get_by_role("button", name="Bending").click()
    tab.page.wait_for_function("document.querySelector('.an-hz:not(th)')?.innerText === '3.76703'")
    tab.page.get_by_label("Pin the frequencies").click()
    tab.page.wait_for_selector(".an-pinned")
    tab.page.get_by_label("from", exact=True).fill("18")
    tab.page.get_by_label("to", exact=True).fill("25")
    tab.page.get_by_label("to", exact=True).press("Enter")
    tab.page.get_by_text("mode 3 in the equipment band").wait_for()
    tab.page.get_by_label("Units").click()
    tab.page.get_by_role("option", name="US").click()
    tab.page.wait_for_function(
        "document.querySelector(\"input[aria-label='speed [ft/s]']\")?.value === '262.467'"
    )
    tab.page.get_by_label("Dark or light").click()
    tab.page.wait_for_selector("body.body--dark")
    assert_clean(tab, address)


def test_the_table_of_stations(tab, address):
    tab.page.get_by_role("button", name="Stations").click()
    cell = tab.page.locator(".ag-row[row-index='9'] [col-id='bending_stiffness']")
    cell.dblclick()
    cell.locator("input").fill("260")
    before = tab.frequency(1)
    cell.locator("input").press("Enter")
    tab.changed(before)
    cell.dblclick()
    cell.locator("input").fill("-1")
    cell.locator("input").press("Enter")
    tab.page.get_by_text("bending_stiffness, row 10: received -1000").first.wait_for()
    tab.page.get_by_role("button", name="Close").click()
    tab.page.get_by_role("button", name="Undo").click()
    tab.page.get_by_role("button", name="Undo").click()
    tab.page.wait_for_selector(".an-main:not(.an-stale)")
    tab.wait_for_frequency("3.76703")
    assert_clean(tab, address)


def cell(tab, row, column):
    """A cell of the table of stations."""
    return tab.page.locator(f".ag-row[row-index='{row}'] [col-id='{column}']")


def type_into(tab, row, column, text):
    """Type into a cell of the table of stations."""
    cell(tab, row, column).dblclick()
    field = cell(tab, row, column).locator("input")
    field.fill(text)
    field.press("Enter")
    tab.settle()  # an answer on its way would end the next cell's editing


def has_text(tab, row, column, text):
    """Wait until a cell shows a text."""
    script = "([place, text]) => document.querySelector(place)?.innerText === text"
    place = f".ag-row[row-index='{row}'] [col-id='{column}']"
    tab.page.wait_for_function(script, arg=[place, text])


def test_cells_take_units_and_say_what_they_refuse(tab, address):
    tab.page.get_by_role("button", name="Stations").click()
    cell(tab, 1, "x").wait_for()
    first = cell(tab, 1, "x").inner_text()
    type_into(tab, 1, "x", "90 mm")
    has_text(tab, 1, "x", "0.09")
    type_into(tab, 1, "x", "0,1")
    has_text(tab, 1, "x", "0.1")
    type_into(tab, 1, "x", "9 kg")
    tab.page.get_by_text("row 2, x: received '9 kg'; 'kg' is no unit of m").wait_for()
    assert "an-cellwrong" in cell(tab, 1, "x").get_attribute("class")
    cell(tab, 2, "x").dblclick()
    cell(tab, 2, "x").locator("input").press("Escape")
    assert cell(tab, 2, "x").is_visible()  # Esc ended the cell, not the dialog
    for _ in range(2):
        tab.page.get_by_role("button", name="Take back").click()
    has_text(tab, 1, "x", first)
    tab.page.keyboard.press("Escape")
    cell(tab, 2, "x").wait_for(state="hidden")
    assert_clean(tab, address)


def test_rows_are_removed_where_they_were_clicked_and_pasted_as_one(tab, address):
    tab.page.get_by_role("button", name="Stations").click()
    cell(tab, 1, "x").wait_for()
    before = [cell(tab, k, "x").inner_text() for k in range(5)]
    cell(tab, 2, "x").click()
    tab.page.get_by_role("button", name="Remove row").click()
    has_text(tab, 2, "x", before[3])
    tab.page.get_by_role("button", name="Take back").click()
    has_text(tab, 2, "x", before[2])
    cell(tab, 1, "bending_stiffness").click()
    tab.page.evaluate(
        """() => {
            const data = new DataTransfer();
            data.setData("text/plain", "1500\\t210000\\n1600\\t220000\\n");
            const event = new ClipboardEvent("paste", {clipboardData: data, bubbles: true});
            document.activeElement.dispatchEvent(event);
        }"""
    )
    has_text(tab, 1, "bending_stiffness", "1500")
    has_text(tab, 2, "bending_stiffness", "1600")
    tab.page.get_by_role("button", name="Take back").click()
    tab.page.get_by_role("button", name="Close").click()
    tab.wait_for_frequency("3.76703")
    assert_clean(tab, address)


def test_no_key_is_lost_and_a_click_on_the_thumb_moves_nothing(tab, address):
    slider = tab.page.locator(".an-slider[aria-label^='thrust']")
    place = ".an-slider[aria-label^='thrust']"
    value = f'document.querySelector("{place}").getAttribute("aria-valuenow")'
    start = float(tab.page.evaluate(value))
    keyboard(tab, "thrust", "ArrowRight", 20)
    tab.settle()
    step = float(tab.page.evaluate(value)) - start
    tab.page.wait_for_function("location.search.includes('thrust')")
    keyboard(tab, "thrust", "ArrowLeft", 20)
    tab.settle()
    assert float(tab.page.evaluate(value)) == pytest.approx(start)
    keyboard(tab, "thrust", "ArrowRight")
    assert step == pytest.approx(20 * (float(tab.page.evaluate(value)) - start))
    tab.settle()
    tab.stand_still()
    thumb = slider.locator(".q-slider__thumb").bounding_box()
    now = tab.page.evaluate(value)
    tab.page.mouse.click(thumb["x"] + thumb["width"] / 2, thumb["y"] + thumb["height"] / 2)
    tab.settle()
    assert tab.page.evaluate(value) == now
    assert_clean(tab, address)


def saved(tab, item):
    """Choose an item of the menu, once a menu that is still closing cannot take the click."""
    tab.page.locator(".q-menu").wait_for(state="detached")
    tab.page.get_by_role("button", name="Save").click()
    with tab.page.expect_download() as waiting:
        tab.page.get_by_text(item).click()
    return waiting.value


def test_downloads(tab, address):
    for item, name in (
        ("The case, as TOML", "case.toml"),
        ("Results, .csv", "modes.csv"),
        ("Results, .json", "modes.json"),
        ("Results, .nc", "modes.nc"),
    ):
        download = saved(tab, item)
        assert download.suggested_filename == name
        content = download.path().read_bytes()
        if name == "case.toml":
            assert tomllib.loads(content.decode())["condition"]["speed"] == "80 m/s"
        if name == "modes.json":
            assert len(json.loads(content)["modes"]) == 15
    assert_clean(tab, address)


def test_a_click_on_a_frequency_shows_that_mode_everywhere(tab, address):
    tab.page.get_by_role("button", name="Show bending 2").click()
    tab.page.wait_for_function("window.antinode.data.mode?.heading === 'bending 2, 10.555 Hz'")
    tab.settle()
    pressed = tab.page.locator(".an-modebutton.an-pressed").all_inner_texts()
    assert pressed == ["2"]
    assert tab.page.get_by_label("Mode of the 3-D view").input_value() == "2"
    assert "an-chosen" in tab.page.locator(".an-table tbody tr").nth(1).get_attribute("class")
    tables = {  # panel, first cells of the table on the clipboard, and how many numbers there are
        "Vehicle in its cavity, to scale, with the forces on it": ("force", "value", 6),
        "Frequencies": ("mode", "frequency [Hz]", 7),
        "Mode shapes": ("x [m]", "mode 2: Y", 100),
        "Forces inside the body": ("curve", "x [m]", 240),
        "Frequencies [Hz] against": ("thrust [kN]", "mode 1 [Hz]", 5),
        "chosen panel": ("curve", "x [m]", 400),
        "Body in mode": ("x / length", "radius / length", 61),
    }
    for panel, (*heads, least) in tables.items():
        tab.page.get_by_label(f"Enlarge: {panel}", exact=True).click()
        tab.page.get_by_label(f"Copy numbers: {panel}", exact=True).click()
        tab.page.wait_for_function(
            "async (start) => (await navigator.clipboard.readText()).startsWith(start)",
            arg="\t".join(heads),
        )
        tab.page.get_by_text("Copied: paste it").last.wait_for()
        rows = tab.page.evaluate("navigator.clipboard.readText()").splitlines()
        assert rows[0].split("\t")[:2] == heads, panel
        assert len(rows) > least, panel
        tab.page.keyboard.press("Escape")
    assert_clean(tab, address)


def test_an_enlarged_chart_zooms_by_the_wheel_and_shows_all_again(tab):
    zoomed = (
        "() => { const z = window.antinode.views.modes.instance.getOption().dataZoom?.[0];"
        " return z ? z.end - z.start : 100; }"
    )
    assert tab.page.evaluate(zoomed) == 100
    tab.page.get_by_label("Enlarge: Mode shapes").click()
    tab.page.wait_for_selector(".an-large")
    tab.settle()
    tab.page.mouse.move(640, 400)
    tab.page.mouse.wheel(0, -600)
    tab.page.wait_for_function(f"({zoomed})() < 95")
    tab.page.mouse.dblclick(640, 400)
    tab.page.wait_for_function(f"({zoomed})() === 100")


def test_switches_of_the_physics_and_what_they_do(tab, address):
    def choose(text):
        tab.page.get_by_role("button", name=text, exact=True).click()

    assert "Not in the model: hydrodynamic stiffness" in tab.page.locator(".an-left").inner_text()
    choose("fixed")
    tab.wait_for_frequency("3.21918")
    choose("thrust")
    tab.wait_for_frequency("3.6933")
    choose("Euler-Bernoulli")
    tab.page.get_by_text("shear deformation and rotary inertia;").wait_for()
    for _ in range(3):
        choose("Undo")
    tab.wait_for_frequency("3.76703")
    pressed = tab.page.get_by_role("button", name="all follow").get_attribute("aria-pressed")
    assert pressed == "true"
    tab.page.get_by_label("What this panel shows").click()
    tab.page.get_by_role("option", name="End forces side by side").click()
    tab.page.get_by_text("3.21918 (-14.54%)").wait_for()
    tab.page.get_by_label("Enlarge: chosen panel").click()
    assert tab.page.locator(".an-large").bounding_box()["width"] > 1200
    tab.page.keyboard.press("Escape")
    tab.page.locator(".an-large").wait_for(state="hidden")
    tab.page.get_by_label("Add a slider").fill("water dens")
    tab.page.get_by_role("option", name="water density").click()
    tab.page.get_by_label("Take away water: density").wait_for()
    copied = tab.page.evaluate("window.antinode.views.frequencies.text()")
    assert copied.splitlines()[1].split("\t")[:2] == ["bending 1", "3.76703"]
    assert_clean(tab, address)


def test_a_beam_is_built_by_hand(context, address):
    tab = Tab(context, address + f"?case={read_example('beam').packed()}")
    before = tab.frequency(1)
    tab.page.get_by_role("button", name="Attach").click()
    tab.page.get_by_role("menuitem", name="Spring", exact=True).click()
    sprung = tab.changed(before)
    mark = tab.page.locator("[data-path='beam.springs.0.x']")
    box = mark.locator(".an-grip").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] - 8
    tab.page.mouse.move(x, y)
    tab.page.mouse.down()
    for step in range(1, 5):
        tab.page.mouse.move(x + 40 * step, y)
    tab.page.mouse.up()
    tab.page.wait_for_function(
        "document.querySelector(\"input[aria-label='spring 1: x [m]']\")?.value > 18"
    )
    here = tab.changed(sprung)
    mark.press("ArrowRight")  # a hundredth of the length
    tab.changed(here)
    tab.page.get_by_role("button", name="Undo").click()
    tab.page.get_by_role("button", name="Undo").click()  # the drag is one step
    place = "input[aria-label='spring 1: x [m]']"
    tab.page.wait_for_function(f'document.querySelector("{place}").value === "15"')
    tab.wait_for_frequency(sprung)
    tab.page.get_by_role("button", name="Take out").click()
    tab.page.get_by_role("menuitem", name="Spring 1").click()
    tab.wait_for_frequency(before)
    tab.page.close()


def test_a_phone_keeps_the_frequencies_in_sight(context, address):
    tab = Tab(context, address, width=390, height=844)
    strip = tab.page.locator(".an-strip")
    assert strip.inner_text().split()[:3] == ["1", "3.76703", "Hz"]
    tab.page.mouse.wheel(0, 900)
    tab.page.wait_for_function("window.scrollY > 0")
    assert strip.bounding_box()["y"] >= 0
    assert tab.page.evaluate("document.documentElement.scrollWidth") <= 390
    tab.page.close()


def test_at_760_pixels_sliders_and_frequencies_are_side_by_side(context, address):
    tab = Tab(context, address, width=760, height=800)
    slider = tab.page.locator(".an-slider").first.bounding_box()
    table = tab.page.locator(".an-at-frequencies").bounding_box()
    assert slider["x"] + slider["width"] < table["x"]
    assert table["y"] + table["height"] < 800
    tab.page.close()


def test_a_link_of_another_file_is_refused_in_words(context, address):
    page = context.new_page()
    page.goto(address + "?file=000000000000&set=%7B%22condition.thrust%22%3A1%7D")
    page.get_by_text("the link belongs to another file than starter.toml").wait_for()
    page.goto(address + "?set=%7B%22condition.speed%22%3A-5%7D")
    page.get_by_text("the link's values are left out").wait_for()
    page.wait_for_selector(".an-table:not(.an-quick) tbody tr")
    page.close()


def test_everything_can_be_reached_by_keyboard_and_has_a_name(tab):
    unnamed = tab.page.evaluate(
        """() => [...document.querySelectorAll(
                '.an-app button, .an-app input, .an-app [role=slider], .an-picture')]
            .filter(e => e.type !== 'file' && !e.closest('[aria-hidden=true]'))
            .filter(e => !(e.getAttribute('aria-label') || e.innerText.trim()
                || e.closest('[aria-label]') || e.labels?.length))
            .map(e => e.outerHTML.slice(0, 120))"""
    )
    assert unnamed == []
    tab.page.locator("body").press("Tab")
    for _ in range(12):
        tab.page.keyboard.press("Tab")
    assert tab.page.evaluate("document.activeElement !== document.body")


def test_the_server_outlives_every_input(context):
    with serving() as (address, process):
        for query in ("?set=%7B", "?case=xyz", "?units=3", "?set=" + "a" * 20_000):
            page = context.new_page()
            page.goto(address + query)
            page.get_by_text("the link is damaged").wait_for()
            page.close()
        tab = Tab(context, address)
        for value in ("1e300", "nan", "-5", "", "__import__('os')", "9" * 60, "1e-300"):
            tab.set_field("speed [m/s]", value)
            tab.set_field("thrust [kN]", value)
        tab.page.locator(".an-message:visible").first.wait_for()
        tab.set_field("speed [m/s]", "81")
        tab.set_field("thrust [kN]", "51")
        tab.settle()
        tab.page.wait_for_selector(".an-main:not(.an-stale)")
        assert re.fullmatch(r"3\.\d+", tab.frequency(1))
        assert tab.errors == []
        assert process.poll() is None
