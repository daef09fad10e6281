"""A headless Chromium, driven by its DevTools protocol; a few lines in place of a package."""

import base64
import contextlib
import json
import shutil
import subprocess
import time
import urllib.request
from pathlib import Path

PROGRAM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), None
)
OPTIONS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
]
FLAT = ["--headless=new", "--no-sandbox", "--disable-gpu"]  # for pages without WebGL: starts and paints faster


class Page:
    """One page: `run` evaluates JavaScript in it."""

    def __init__(self, socket):
        self._socket = socket
        self._number = 0
        self.errors = []
        self.messages = []  # of the console, and those of the browser once `listen` was called
        self.requests = []  # addresses that were asked for, once `listen` was called

    def call(self, method, **parameters):
        self._number += 1
        self._socket.send(json.dumps({"id": self._number, "method": method, "params": parameters}))
        while True:
            answer = json.loads(self._socket.recv(timeout=60))
            if answer.get("method") == "Runtime.exceptionThrown":
                self.errors.append(answer["params"]["exceptionDetails"]["exception"].get("description", ""))
            elif answer.get("method") == "Runtime.consoleAPICalled":
                self.messages.append(" ".join(str(one.get("value", one)) for one in answer["params"]["args"]))
            elif answer.get("method") == "Network.requestWillBeSent":
                self.requests.append(answer["params"]["request"]["url"])
            elif answer.get("method") == "Log.entryAdded":
                self.messages.append(answer["params"]["entry"]["text"])
            if answer.get("id") == self._number:
                assert "error" not in answer, answer
                return answer["result"]

    def run(self, code):
        answer = self.call("Runtime.evaluate", expression=code, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def wait_for(self, code, seconds=60.0):
        """Return the first value of an expression that counts as true."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if value := self.run(code):
                return value
            time.sleep(0.05)
        raise AssertionError(f"after {seconds} s still nothing: {code}")

    def key(self, name, times=1):
        for _ in range(times):
            for kind in ("keyDown", "keyUp"):
                self.call("Input.dispatchKeyEvent", type=kind, key=name, code=name, windowsVirtualKeyCode=KEYS[name])

    def listen(self):
        """Also note what the browser says of a page: what it did not load, a policy that was broken, its requests."""
        self.call("Log.enable")
        self.call("Network.enable")

    def open(self, path, width=1280, height=800, media=""):
        """Load a file in a window of a size, on screen or as it is printed."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.call("Emulation.setEmulatedMedia", media=media)
        self.call("Emulation.setScrollbarsHidden", hidden=media == "print")
        self.call("Page.navigate", url=Path(path).as_uri())
        self.wait_for(f"document.readyState === 'complete' && location.href === {json.dumps(Path(path).as_uri())}")

    def pdf(self, path):
        """Print to A4."""
        printed = self.call("Page.printToPDF", paperWidth=8.27, paperHeight=11.69, preferCSSPageSize=True)
        Path(path).write_bytes(base64.b64decode(printed["data"]))

    def picture(self, path):
        Path(path).write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))


KEYS = {"ArrowRight": 39, "ArrowLeft": 37}


@contextlib.contextmanager
def page(url, profile, width=1280, height=800, options=OPTIONS):
    """Open a page; `profile` is an empty folder."""
    from websockets.sync.client import connect

    where = [f"--user-data-dir={profile}", "--remote-debugging-port=0", f"--window-size={width},{height}"]
    browser = subprocess.Popen(
        [PROGRAM, *options, *where, "--no-first-run", "about:blank"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        note = Path(profile) / "DevToolsActivePort"
        end = time.monotonic() + 60.0
        while not (note.exists() and note.read_text().count("\n")):
            assert browser.poll() is None, "Chromium ended by itself"
            assert time.monotonic() < end, "Chromium does not start"
            time.sleep(0.05)
        port = note.read_text().split()[0]
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/json/list", timeout=30) as answer:
            target = next(one for one in json.load(answer) if one["type"] == "page")
        with connect(target["webSocketDebuggerUrl"], max_size=2**27) as socket:
            made = Page(socket)
            made.call("Runtime.enable")
            made.call("Page.enable")
            made.call(
                "Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False
            )
            made.call("Page.navigate", url=url)
            yield made
            with contextlib.suppress(Exception):
                made.call("Browser.close")
    finally:
        browser.terminate()
        try:
            browser.wait(timeout=20)
        except subprocess.TimeoutExpired:
            browser.kill()
            browser.wait()
