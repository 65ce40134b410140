"""The page of faststrip-explore served, and a browser without a screen that shows it: for its test
and for tools/measure/bench_page.py."""

import re
import shutil
import signal
import subprocess
import sys

BROWSER, DRIVER = (shutil.which(name) for name in ("chromium", "chromedriver"))
WIDTH, HEIGHT = 1280, 720
# Long enough for a machine ten times slower, s.
PATIENCE = 120


class Served:
    """A page that is served until `end`."""

    def __init__(self, environment, folder, *words):
        self.process = subprocess.Popen(
            [sys.executable, "-m", "faststrip.explore", "--no-browser", "--port", "0", *words],
            cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            encoding="utf-8", env=environment)
        line = self.process.stdout.readline()
        found = re.search(r"http://127\.0\.0\.1:\d+/", line)
        if found is None:
            raise RuntimeError(f"no page: {line}{self.process.communicate()[1]}")
        self.address = found[0]
        self.port = int(self.address.rsplit(":", 1)[1].strip("/"))

    def end(self):
        """Ctrl-C; the exit code and what was said on stderr."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        said = self.process.communicate(timeout=PATIENCE)[1]
        return self.process.returncode, said


def start_browser(downloads=None):
    """A chromium of 1280 x 720 pixels that draws with the processor alone."""
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    options.binary_location = BROWSER
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--hide-scrollbars"):
        options.add_argument(word)
    if downloads is not None:
        options.add_experimental_option("prefs", {"download.default_directory": str(downloads)})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(options, webdriver.ChromeService(DRIVER))
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": WIDTH, "height": HEIGHT, "deviceScaleFactor": 1, "mobile": False})
    browser.set_script_timeout(PATIENCE)
    return browser
