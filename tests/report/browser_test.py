#!/usr/bin/python3
"""browser_test.py SAMPLE_PAGE: what a person does to the page of a campaign, in headless Chromium.

SAMPLE_PAGE is the program that writes the page. Needs Debian's chromium, chromium-driver and python3-selenium; without
them, or without WebGL, the test fails.
"""

import csv
import hashlib
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

PATIENCE = 60  # seconds, for one thing to happen on a loaded machine
# Software rendering; nothing of the browser's own may use the network, or a profile.
FLAGS = """--headless=new --no-sandbox --disable-quic --no-first-run --disable-background-networking --disable-sync
  --disable-component-update --disable-dev-shm-usage --window-size=1400,1000 --force-device-scale-factor=1
  --force-prefers-reduced-motion""".split()
WEBGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


def start_browser(profile, flags):
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for flag in FLAGS + flags + [f"--user-data-dir={profile}"]:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    browser.set_script_timeout(PATIENCE)
    browser.execute_cdp_cmd("Network.enable", {})
    browser.execute_cdp_cmd("Network.emulateNetworkConditions",
                            {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})
    return browser


def wait_for(what, condition):
    end = time.monotonic() + PATIENCE
    while not (value := condition()):
        if time.monotonic() > end:
            raise AssertionError(f"waited {PATIENCE} s for {what}")
        time.sleep(0.05)
    return value


class PageTest(unittest.TestCase):
    """One browser and one page for all tests of a class; each test leaves the page as it found it."""

    flags = WEBGL

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        subprocess.run([sample_page, cls.folder / "page"], check=True, timeout=PATIENCE)
        cls.browser = start_browser(cls.folder / "profile", cls.flags)
        cls.addClassCleanup(cls.browser.quit)
        # The page alone: nothing that was beside it when it was written.
        page = (cls.folder / "page" / "report.html").rename(cls.folder / "report.html")
        cls.browser.get(page.as_uri())

    def run_script(self, script, *values):
        return self.browser.execute_script(script, *values)

    def element(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.run_script("return document.querySelector(arguments[0]).textContent", selector)

    def assert_console_is_clean(self):
        self.assertEqual([line for line in self.browser.get_log("browser") if line["level"] in ("SEVERE", "WARNING")], [])


class Page(PageTest):
    def setUp(self):
        self.addCleanup(self.assert_console_is_clean)
        wait_for("the first run or a message", lambda: self.shown_run() or self.text("#view-message"))
        self.assertEqual(self.text("#view-message"), "")

    # -- the page --

    def test_renders_its_parts(self):
        self.assertEqual(self.browser.title, 'Granules on a wall: "8 < v & v < 48 m/s"')
        self.assertEqual(self.text(".verdicts li:first-child"), "The chipping ratio grows with v², within 5 %.")
        links = self.browser.find_elements(By.CSS_SELECTOR, "#contents a")
        self.assertEqual([link.text for link in links],
                         ["Chipping & <breakage>", "Energy", "Fragments in 3-D", "Pictures", "All runs"])
        for picture in self.browser.find_elements(By.CSS_SELECTOR, ".enlarge img"):
            self.run_script("arguments[0].scrollIntoView()", picture)
            wait_for("a picture", lambda: self.run_script("return arguments[0].naturalWidth", picture) > 0)
        self.assertEqual(self.run_script("return performance.getEntriesByType('resource')"
                                         ".map(entry => entry.name).filter(name => !/^(data|blob):/.test(name))"), [])

    def test_pictures_are_enlarged(self):
        self.run_script("document.querySelector('.plot .enlarge').click()")
        large = self.element("#large")
        self.assertTrue(large.is_displayed())
        self.assertEqual(self.element("#large p").text, 'Points: runs. Line: "fit".')
        large.send_keys(Keys.ESCAPE)
        wait_for("the end of the dialog", lambda: not large.is_displayed())

    # -- the table --

    def column(self, name):
        """The row numbers and full cells of a column, as they are shown."""
        return self.run_script(
            """const place = [...document.querySelectorAll("#runs-table thead th")].findIndex(th => th.title === arguments[0]);
            return [...document.querySelectorAll("#runs-table tbody tr")].map(tr => [Number(tr.dataset.row),
              tr.cells[place].title])""", name)

    def head(self, name):
        return next(th for th in self.browser.find_elements(By.CSS_SELECTOR, "#runs-table thead th")
                    if th.get_attribute("title") == name)

    def unsort(self):
        """Any other column first, so that the next one begins ascending."""
        self.run_script("arguments[0].click()", self.head("breakage.class").find_element(By.TAG_NAME, "button"))

    def sort_by(self, name, direction, keys=None):
        button = self.head(name).find_element(By.TAG_NAME, "button")
        button.send_keys(keys) if keys else self.run_script("arguments[0].click()", button)
        self.assertEqual(self.head(name).get_attribute("aria-sort"), direction)
        others = self.browser.find_elements(By.CSS_SELECTOR, "#runs-table th[aria-sort]:not([aria-sort=none])")
        self.assertEqual(len(others), 1)

    def assert_sorted(self, name, descending):
        rows = self.column(name)
        data = self.run_script("return JSON.parse(document.getElementById('table').textContent)")
        place = data["columns"].index(name)
        full = [(i, row[place]) for i, row in enumerate(data["rows"])]
        filled = [(i, cell) for i, cell in full if cell]
        expected = sorted(filled, key=lambda row: float(row[1]), reverse=descending) + [row for row in full if not row[1]]
        self.assertGreater(len(filled), 5)
        self.assertEqual([(i, cell) for i, cell in rows], expected)

    def test_columns_sort_as_numbers_both_ways_with_empty_cells_last(self):
        self.unsort()
        for name in ("impact.speed [m/s]", "energy.closure_error", "breakage.chipping_ratio", "breakage.t10"):
            self.sort_by(name, "ascending")
            self.assert_sorted(name, False)
            self.sort_by(name, "descending")
            self.assert_sorted(name, True)

    def test_sorts_by_keyboard_and_keeps_the_focus(self):
        self.unsort()
        self.sort_by("impact.speed [m/s]", "ascending", Keys.ENTER)
        self.browser.switch_to.active_element.send_keys(Keys.SPACE)
        self.assertEqual(self.head("impact.speed [m/s]").get_attribute("aria-sort"), "descending")
        self.assert_sorted("impact.speed [m/s]", True)

    def test_text_sorts_by_the_numbers_in_it(self):
        self.unsort()
        self.sort_by("run", "ascending")
        speeds = [int(re.match(r"speed_(\d+)mps", cell)[1]) for _, cell in self.column("run")]
        self.assertEqual(speeds, list(range(8, 48)))

    def test_filter_keeps_the_rows_with_all_its_words(self):
        field = self.element("#filter")
        field.send_keys("intact speed_1")
        data = self.run_script("return JSON.parse(document.getElementById('table').textContent)")
        fitting = sorted(i for i, row in enumerate(data["rows"]) if "intact" in row and "speed_1" in row[0])
        self.assertGreater(len(fitting), 2)
        self.assertEqual(sorted(i for i, _ in self.column("run")), fitting)
        self.assertEqual(self.text("#row-count"), f"{len(fitting)} of 40 runs")
        field.send_keys(" nothing")
        self.assertEqual(self.text("#runs-table tbody"), "No run fits the filter.")
        field.clear()
        field.send_keys(" ")
        self.assertEqual(self.text("#row-count"), "40 runs")

    def test_columns_are_chosen(self):
        shown = lambda: [th.get_attribute("title") for th in
                         self.browser.find_elements(By.CSS_SELECTOR, "#runs-table thead th")]
        start = shown()
        self.assertEqual(start[:4], ["run", "state", "impact.speed [m/s]", "run.seed"], "first what varies")
        self.assertIn("breakage.chipping_ratio", start)
        self.assertNotIn("only.when <b>shown</b>", start)
        self.run_script("document.getElementById('columns').open = true")
        self.element("#column-filter").send_keys("only.")
        wait_for("one column", lambda: len(self.browser.find_elements(By.CSS_SELECTOR, "#column-list input")) == 1)
        self.element("#column-list input").click()
        self.assertEqual(shown(), start + ["only.when <b>shown</b>"])
        self.element("#columns-default").click()
        self.assertEqual(shown(), start)
        self.element("#column-filter").clear()
        self.run_script("document.getElementById('columns').open = false")

    def test_numbers_are_rounded_with_the_full_value_in_the_tooltip(self):
        cells = self.browser.find_elements(By.CSS_SELECTOR, "#runs-table td.number")
        texts = {cell.get_attribute("title"): cell.text for cell in cells}
        self.assertEqual(texts["0.016049371"], "0.01605")
        self.assertEqual(texts["1e-09"], "1e−9")

    def test_saves_what_is_shown_as_csv(self):
        downloads = self.folder / "downloads"
        self.browser.execute_cdp_cmd("Browser.setDownloadBehavior",
                                     {"behavior": "allow", "downloadPath": str(downloads)})
        self.unsort()
        self.sort_by("impact.speed [m/s]", "ascending")
        self.run_script("document.getElementById('save-table').click()")
        file = downloads / "runs.csv"
        wait_for("runs.csv", lambda: file.exists() and file.stat().st_size > 0)
        with open(file, newline="", encoding="utf-8") as stream:
            lines = list(csv.reader(stream))
        self.assertEqual(lines[0][:3], ["run", "state", "impact.speed [m/s]"])
        self.assertEqual([float(line[2]) for line in lines[1:]], list(range(8, 48)))

    # -- the view --

    def shown_run(self):
        return self.run_script("return document.getElementById('view').dataset.shown")

    def picture(self):
        """The view as it is now: equal for equal pixels."""
        return hashlib.sha256(self.run_script("return knapPage.viewer.picture()").encode()).hexdigest()

    def move_apart(self, percent):
        self.run_script("""const slider = document.getElementById("apart"); slider.value = arguments[0];
                           slider.dispatchEvent(new Event("input"))""", percent)

    def reset(self):
        self.run_script("document.getElementById('reset-view').click()")

    def colours(self):
        """Of the pixels that are blue, orange and green, as the first three fragments are, the number and mean place."""
        return self.run_script(
            """knapPage.viewer.picture();
            const view = document.getElementById("view"), copy = document.createElement("canvas");
            [copy.width, copy.height] = [view.width, view.height];
            const context = copy.getContext("2d");
            context.drawImage(view, 0, 0);
            const data = context.getImageData(0, 0, copy.width, copy.height).data;
            const seen = {size: copy.width * copy.height};
            for (const name of ["all", "blue", "orange", "green"]) seen[name] = {count: 0, x: 0, y: 0};
            const add = (name, i) => {
              ++seen[name].count;
              seen[name].x += i / 4 % copy.width;
              seen[name].y += Math.floor(i / 4 / copy.width);
            };
            for (let i = 0; i < data.length; i += 4) {
              const [r, g, b, a] = data.subarray(i, i + 4);
              if (a < 255) continue;
              add("all", i);
              if (b > 1.5 * r && b > 1.15 * g) add("blue", i);
              if (r > 1.3 * g && g > 1.5 * b) add("orange", i);
              if (g > 1.3 * r && g > 1.3 * b) add("green", i);
            }
            for (const name of ["all", "blue", "orange", "green"]) {
              seen[name].x /= seen[name].count;
              seen[name].y /= seen[name].count;
            }
            return seen""")

    def distance_of_fragments(self):
        """Between the blue and the orange one as they are seen, over their size: zooming leaves it as it is."""
        seen = self.colours()
        blue, orange = seen["blue"], seen["orange"]
        return math.hypot(blue["x"] - orange["x"], blue["y"] - orange["y"]) / math.sqrt(blue["count"] + orange["count"])

    def test_fragments_are_drawn_in_their_colours(self):
        self.reset()
        seen = self.colours()
        self.assertGreater(seen["all"]["count"], 0.1 * seen["size"])
        for colour in ("blue", "orange", "green"):
            self.assertGreater(seen[colour]["count"], 0.005 * seen["size"], (colour, seen))
        legend = [line.text for line in self.browser.find_elements(By.CSS_SELECTOR, "#legend li")]
        self.assertEqual(legend[0].split("\n")[0], "Fragment 1")
        self.assertRegex(legend[-1], r"^Fines, \d+ below 0.1 %")

    def test_tells_the_fragment_under_the_pointer(self):
        self.reset()
        start, view = self.picture(), self.element("#view")
        self.run_script("arguments[0].scrollIntoView()", view)
        half = view.size["width"] / 2, view.size["height"] / 2
        for colour, name in (("blue", "Fragment 1: "), ("orange", "Fragment 2: "), ("green", "Fragment 3: ")):
            seen = self.colours()[colour]
            place = round(seen["x"] - half[0]), round(seen["y"] - half[1])
            webdriver.ActionChains(self.browser).move_to_element_with_offset(view, *place).perform()
            wait_for(name, lambda: self.text("#view-pointed").startswith(name))
        webdriver.ActionChains(self.browser).move_to_element_with_offset(view, 5 - round(half[0]), 0).perform()
        wait_for("nothing", lambda: self.text("#view-pointed") == "")
        self.assertEqual(self.picture(), start)

    def test_slider_moves_fragments_apart_and_back(self):
        self.reset()
        together, distance = self.picture(), self.distance_of_fragments()
        self.move_apart(100)
        self.assertNotEqual(self.picture(), together)
        self.assertGreater(self.distance_of_fragments(), 1.2 * distance)
        self.move_apart(200)
        self.assertGreater(self.distance_of_fragments(), 1.4 * distance)
        self.assertEqual(self.text("#apart-value"), "200 %")
        self.move_apart(0)
        self.assertEqual(self.picture(), together)

    def test_drag_wheel_and_keys_turn_and_zoom(self):
        self.reset()
        start = self.picture()
        view = self.element("#view")
        self.run_script("arguments[0].scrollIntoView()", view)
        webdriver.ActionChains(self.browser).click_and_hold(view).move_by_offset(120, 30).release().perform()
        turned = self.picture()
        self.assertNotEqual(turned, start)
        origin = webdriver.common.actions.wheel_input.ScrollOrigin.from_element(view)
        before, scroll = self.colours()["all"]["count"], self.run_script("return scrollY")
        webdriver.ActionChains(self.browser).scroll_from_origin(origin, 0, -200).perform()
        wait_for("the zoom", lambda: self.colours()["all"]["count"] > 1.1 * before)
        self.assertEqual(self.run_script("return scrollY"), scroll, "the page stays")
        for key in (Keys.ARROW_LEFT, Keys.ARROW_UP, "-"):
            last = self.picture()
            view.send_keys(key)
            self.assertNotEqual(self.picture(), last, key)
        view.send_keys(Keys.HOME)
        self.assertEqual(self.picture(), start)

    def test_switches_change_the_view(self):
        self.reset()
        self.move_apart(100)  # the fines lie under the rest
        start = self.picture()
        for name in ("fines", "lines", "wall"):
            box = self.element(f"#show-{name}")
            box.click()
            self.assertNotEqual(self.picture(), start, name)
            box.click()
            self.assertEqual(self.picture(), start, name)

    def test_another_run_is_shown_by_list_and_table(self):
        self.reset()
        options = self.browser.find_elements(By.CSS_SELECTOR, "#run-choice option")
        names = [option.get_attribute("title") for option in options]
        self.assertEqual(len(names), 2)
        self.assertEqual(self.shown_run(), names[0])
        first = self.picture()
        self.run_script("document.getElementById('run-after').click()")
        wait_for("the second run", lambda: self.shown_run() == names[1])
        self.assertNotEqual(self.picture(), first)
        self.assertIn(names[1], self.text("#view-caption"))
        self.assertEqual(self.element("#runs-table tr.shown th").get_attribute("title"), names[1])
        links = self.browser.find_elements(By.CSS_SELECTOR, "#runs-table .to-view")
        self.assertEqual(sorted(link.text for link in links), sorted(names))
        self.run_script("arguments[0].click()", next(link for link in links if link.text == names[0]))
        wait_for("the first run", lambda: self.shown_run() == names[0])
        self.assertEqual(self.picture(), first)

    def test_view_fits_a_narrow_window(self):
        self.reset()
        start = self.picture()
        self.browser.set_window_size(700, 900)
        wait_for("a narrow view", lambda: self.run_script("return document.getElementById('view').clientWidth") < 690)
        seen = self.colours()
        self.assertGreater(seen["all"]["count"], 0.1 * seen["size"])
        self.assertLessEqual(self.run_script("return document.documentElement.scrollWidth"),
                             self.run_script("return innerWidth"))
        self.browser.set_window_size(1400, 1000)
        wait_for("the wide view", lambda: self.picture() == start)


class WithoutWebGL(PageTest):
    flags = ["--disable-gpu", "--disable-3d-apis"]

    def test_says_so_and_the_rest_works(self):
        self.assertIn("needs WebGL", self.text("#view-message"))
        self.assertTrue(self.element("#view-message").is_displayed())
        self.assertEqual(self.text("#row-count"), "40 runs")
        self.assert_console_is_clean()


if __name__ == "__main__":
    sample_page = sys.argv.pop(1)
    unittest.main(verbosity=2)
