"""A browser without a window, driven through its debugging protocol."""

import json
import os
import shutil
import signal
import subprocess
import tempfile
import time

PROGRAM = next((path for name in ("chromium-headless-shell", "chromium") if (path := shutil.which(name))), None)


class Browser:
    """One page, of 1200 by 800 pixels, drawn by the processor. Use it in a `with`.

    It is talked to by pipes, at the browser's descriptors 3 and 4, and ends when they do.
    """

    def __init__(self):
        self.profile = tempfile.TemporaryDirectory(prefix="maille-browser-", ignore_cleanup_errors=True)
        theirs_in, our_out = os.pipe()
        our_in, theirs_out = os.pipe()
        arguments = ["--headless", "--no-sandbox", "--remote-debugging-pipe", "--use-angle=swiftshader",
                     "--enable-unsafe-swiftshader", f"--user-data-dir={self.profile.name}", "--window-size=1200,800",
                     "about:blank"]
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{theirs_in} 4>&{theirs_out}', "bash", PROGRAM,
             *arguments], pass_fds=(theirs_in, theirs_out), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            start_new_session=True)
        os.close(theirs_in)
        os.close(theirs_out)
        self.output, self.input = os.fdopen(our_out, "wb", buffering=0), os.fdopen(our_in, "rb")
        self.count = 0
        self.events = []
        self.session = {}
        try:
            target = self.call("Target.createTarget", url="about:blank")["targetId"]
            self.session = {"sessionId": self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]}
            for domain in ("Page", "Runtime", "Log", "Network"):
                self.call(f"{domain}.enable")
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.output.close()
        self.input.close()
        # The browser is many processes, behind a script.
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.profile.cleanup()

    def receive(self):
        """The next message: they end in a zero byte."""
        message = bytearray()
        while not message.endswith(b"\0"):
            byte = self.input.read(1)
            if not byte:
                raise EOFError("the browser has ended")
            message += byte
        return json.loads(message[:-1])

    def call(self, method, **parameters):
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters, **self.session}
        self.output.write(json.dumps(message).encode() + b"\0")
        while True:
            message = self.receive()
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
