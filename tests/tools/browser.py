"""A browser without a window, driven through its debugging protocol."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import urllib.request

try:
    import websocket
except ImportError:
    websocket = None

PROGRAM = next((path for name in ("chromium-headless-shell", "chromium") if (path := shutil.which(name))), None)


def why_missing():
    """None where a browser can be driven."""
    if PROGRAM is None:
        return "Chromium isn't installed"
    return "python3-websocket isn't installed" if websocket is None else None


class Browser:
    """One page, of 1200 by 800 pixels, drawn by the processor. Use it in a `with`."""

    def __init__(self):
        self.profile = tempfile.TemporaryDirectory(prefix="maille-browser-", ignore_cleanup_errors=True)
        self.process = subprocess.Popen(
            [PROGRAM, "--headless", "--no-sandbox", "--remote-debugging-port=0", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", f"--user-data-dir={self.profile.name}", "--window-size=1200,800",
             "--remote-allow-origins=*", "about:blank"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            start_new_session=True)
        self.count = 0
        self.events = []
        try:
            self.socket = websocket.create_connection(self.find_page(), timeout=60)
            for domain in ("Page", "Runtime", "Log", "Network"):
                self.call(f"{domain}.enable")
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()
        self.close()

    def close(self):
        # The browser is many processes, behind a script.
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.profile.cleanup()

    def find_page(self):
        port = pathlib.Path(self.profile.name) / "DevToolsActivePort"
        deadline = time.monotonic() + 30
        while time.monotonic() < deadline:
            if port.exists() and (lines := port.read_text().split()):
                with urllib.request.urlopen(f"http://127.0.0.1:{lines[0]}/json") as answer:
                    for target in json.load(answer):
                        if target["type"] == "page":
                            return target["webSocketDebuggerUrl"]
            time.sleep(0.05)
        raise TimeoutError("the browser doesn't start")

    def call(self, method, **parameters):
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv())
            if message.get("id") == self.count:
                if "error" in message:
                    raise RuntimeError(message["error"])
                return message["result"]
            self.events.append(message)

    def js(self, expression):
        """The value of an expression of JavaScript, when it has come where it is a promise."""
        result = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"])
        return result["result"].get("value")

    def open(self, path):
        """Opens a page of ours and waits until it is ready."""
        self.events.clear()
        self.call("Page.navigate", url=path.resolve().as_uri())
        deadline = time.monotonic() + 60
        ready = f"location.href === {json.dumps(path.resolve().as_uri())} && document.documentElement?.dataset.ready === 'yes'"
        while not self.js(ready):
            if time.monotonic() > deadline:
                raise TimeoutError(f"the page isn't ready: {self.complaints()}")
            time.sleep(0.05)
        self.settle()

    def settle(self):
        """Until what was asked for is drawn."""
        self.js("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def place(self, selector):
        """The middle of an element, scrolled into view."""
        return self.js(f"""(() => {{
            const element = document.querySelector({json.dumps(selector)});
            element.scrollIntoView({{block: 'nearest'}});
            const box = element.getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2];
        }})()""")

    def click(self, selector, shift=False):
        x, y = self.place(selector)
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1, modifiers=8 * shift)
        self.settle()

    def press(self, key):
        text = "\r" if key == "Enter" else key if len(key) == 1 else ""
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, text=text if kind == "keyDown" else "")
        self.settle()

    def text(self, selector):
        return self.js(f"document.querySelector({json.dumps(selector)}).textContent")

    def complaints(self):
        """What the page said on its console, and what went wrong in it."""
        found = []
        for event in self.events:
            about = event.get("params", {})
            if event.get("method") == "Runtime.consoleAPICalled":
                found.append([argument.get("value", argument.get("description")) for argument in about["args"]])
            elif event.get("method") == "Runtime.exceptionThrown":
                found.append(about["exceptionDetails"])
            elif event.get("method") == "Log.entryAdded":
                found.append(about["entry"]["text"])
        return found

    def requests(self):
        """The addresses that were asked for."""
        return [event["params"]["request"]["url"] for event in self.events
                if event.get("method") == "Network.requestWillBeSent"]
