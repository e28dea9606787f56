"""The example of cli/manual/feeding.md with a real MQTT broker.

  feeding_test.py ERRMAP ROOT

Skips (status 77) without mosquitto, or the Python module paho of Debian.
"""

import csv
import json
import math
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time

SECONDS = 60
OLD = 3.0  # s, in the place of the example's 30
# Every client of this process meets the broker of the test.
RUN = """import runpy, sys
import paho.mqtt.client as mqtt
connect = mqtt.Client.connect
mqtt.Client.connect = lambda self, host: connect(self, host, {port})
sys.argv = sys.argv[1:]
runpy.run_path("feed.py", run_name="__main__")
"""


def skip(why):
    print("skipped: " + why)
    sys.exit(77)


def run(*words, folder):
    return subprocess.run(words, cwd=folder, check=True, text=True,
                          capture_output=True).stdout


def free_port():
    with socket.socket() as any_port:
        any_port.bind(("localhost", 0))
        return any_port.getsockname()[1]


def prepare(errmap, root, folder):
    """The map, the example and what `predict` says of the readings sent."""
    run(errmap, "simulate", "turning-centre", "-o", "sim", "--days", "3",
        "--cycles", "2", "--seed", "3", "--quiet", folder=folder)
    data = "sim/x_displacement_down.csv"
    run(errmap, "fit", data, "--model", "poly:ridge:view=history", "--inputs",
        "position_mm,t03_degC,t12_degC", "-o", "xup.json", "--quiet",
        "--no-interval", folder=folder)
    run(errmap, "export", "xup.json", "--python", "-o", ".", "--quiet",
        folder=folder)
    page = (root / "cli/manual/feeding.md").read_text(encoding="utf-8")
    example = re.search(r"```python\n(.*?)```", page, re.S)[1]
    assert "MACHINE, OLD = \"machine/x/\", 30.0" in example
    (folder / "feed.py").write_text(example.replace("30.0", str(OLD)))
    with open(folder / data, encoding="utf-8") as text:
        first = next(csv.DictReader(text))
    predicted = next(csv.DictReader(
        run(errmap, "predict", "xup.json", data, folder=folder).splitlines()))
    return first, float(predicted["predicted"])


def main():
    errmap, root = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
    broker = shutil.which("mosquitto") or shutil.which(
        "mosquitto", path="/usr/sbin:/usr/local/sbin")
    if broker is None:
        skip("no mosquitto; apt-get install mosquitto")
    try:
        import paho.mqtt.client as mqtt
    except ImportError:
        skip("no paho for this Python; apt-get install python3-paho-mqtt")
    with tempfile.TemporaryDirectory(prefix="errmap_feeding_") as name:
        folder = pathlib.Path(name)
        first, predicted = prepare(errmap, root, folder)
        port = free_port()
        (folder / "run.py").write_text(RUN.format(port=port))
        running = [subprocess.Popen([broker, "-p", str(port)],
                                    stdout=subprocess.DEVNULL,
                                    stderr=subprocess.DEVNULL)]
        try:
            client = mqtt.Client()
            for _ in range(100):
                try:
                    client.connect("localhost", port)
                    break
                except OSError:
                    time.sleep(0.05)
            got = []
            client.on_message = lambda client, userdata, message: got.append(
                json.loads(message.payload))
            client.subscribe("machine/x/compensation")
            client.loop_start()
            running.append(subprocess.Popen(
                [sys.executable, "-B", "run.py", "feed.py", "localhost"],
                cwd=folder))
            inputs = ["position_mm", "t03_degC", "t12_degC"]

            def send(names, until):
                end = time.monotonic() + SECONDS
                while time.monotonic() < end:
                    for column in names:
                        client.publish("machine/x/reading/" + column,
                                       first[column])
                    time.sleep(0.1)
                    if got and until(got[-1]):
                        return True
                return False

            follows = send(inputs, lambda last: abs(
                last["value"] + predicted) < 1e-12)
            sys.path.insert(0, str(folder))
            import xup
            # Until it has settled it is not healthy.
            settles = got[-1]["status"] & ~(xup.SETTLING | xup.UNHEALTHY) == 0
            held = send(inputs[:2], lambda last: bool(
                last["status"] & xup.INVALID))
            kept = math.isclose(got[-1]["value"], -predicted, abs_tol=1e-12)
        finally:
            for process in reversed(running):
                process.terminate()
                process.wait()
    results = {"the compensation is minus what predict says": follows,
               "the status says nothing but that it settles": settles,
               "a reading that stops coming is not a number": held,
               "and the last good compensation is held": kept}
    for what, holds in results.items():
        print(("ok    " if holds else "FAILED ") + what
              + ("" if holds else f" ({got[-3:]}, predicted {predicted})"))
    return 0 if all(results.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
