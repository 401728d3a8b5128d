#!/usr/bin/python3
"""A session on three hosts: network namespaces on one bridge, 100 Mbit/s each (tbf on what each sends); then with 0.1 ms
and with 20 ms of delay each way towards the render node (a relay of Ethernet frames through two TAP devices, for
kernels without netem), and with 1 % of the packets that each gets lost (nft). Every picture must be the one of three
processes on one machine.

usage: three_hosts.py TRIPTYCH FOLDER; exit 77 where the machine does not allow it."""
import fcntl, heapq, json, os, pathlib, select, shutil, signal, struct, subprocess, sys, threading, time

program, folder = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
own = f"tri{os.getpid() % 10000}"
hosts = {name: f"{own}-{name}" for name in ("render", "zero", "one")}
bridge = f"{own}-bridge"


def skip(why):
    print(f"SKIPPED: three hosts cannot be built here: {why}", flush=True)
    sys.exit(77)


def run(*command, check=True):
    return subprocess.run(command, check=check, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout


def inside(space, *command, check=True):
    return run("ip", "netns", "exec", space, *command, check=check)


def tap(name):
    """A TAP device and the descriptor that its frames come through; it may be moved to another namespace."""
    descriptor = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(descriptor, 0x400454CA, struct.pack("16sH", name.encode(), 0x0002 | 0x1000))
    return descriptor


def relay(one, other, delay, stop):
    """Carries frames both ways, each so many seconds later."""
    waiting = []
    while not stop.is_set():
        now = time.monotonic()
        while waiting and waiting[0][0] <= now:
            _, _, to, frame = heapq.heappop(waiting)
            try:
                os.write(to, frame)
            except OSError:
                pass  # what an Ethernet cannot carry it drops
        timeout = min(0.01, waiting[0][0] - now) if waiting else 0.01
        for ready in select.select([one, other], [], [], max(0, timeout))[0]:
            for _ in range(64):
                try:
                    frame = os.read(ready, 65536)
                except OSError:
                    break
                due = time.monotonic() + delay
                heapq.heappush(waiting, (due, len(waiting) + due, other if ready == one else one, frame))


class Network:
    """Three hosts on a bridge; `delay` seconds of it on the render node's way, `loss` percent everywhere."""

    def __init__(self, delay=0.0, loss=0):
        self.delay, self.loss, self.stop, self.thread, self.taps = delay, loss, threading.Event(), None, []

    def __enter__(self):
        try:
            for space in (*hosts.values(), bridge):
                run("ip", "netns", "add", space)
                inside(space, "ip", "link", "set", "lo", "up")
            inside(bridge, "ip", "link", "add", "name", "bridge0", "type", "bridge")
            inside(bridge, "ip", "link", "set", "bridge0", "up")
            for number, (name, space) in enumerate(hosts.items(), 1):
                near, far = f"t{own[3:]}n{number}", f"t{own[3:]}f{number}"
                if self.delay and name == "render":
                    self.taps = [tap(near), tap(far)]
                else:
                    run("ip", "link", "add", near, "type", "veth", "peer", "name", far)
                run("ip", "link", "set", near, "netns", space)
                run("ip", "link", "set", far, "netns", bridge)
                inside(bridge, "ip", "link", "set", far, "master", "bridge0", "up")
                inside(space, "ip", "addr", "add", f"10.77.0.{number}/24", "dev", near)
                inside(space, "ip", "link", "set", near, "up")
                inside(space, "tc", "qdisc", "add", "dev", near, "root", "tbf", "rate", "100mbit", "burst", "32kb", "latency", "50ms")
                if self.loss:
                    rules = f"table inet lossy {{ chain in {{ type filter hook input priority 0; iif != lo numgen random mod 100 < {self.loss} drop\n}}\n}}\n"
                    subprocess.run(["ip", "netns", "exec", space, "nft", "-f", "-"], input=rules, text=True, check=True)
            if self.taps:
                self.thread = threading.Thread(target=relay, args=(*self.taps, self.delay, self.stop))
                self.thread.start()
        except (subprocess.CalledProcessError, OSError) as error:
            self.__exit__()
            skip(f"{error} {getattr(error, 'stdout', '') or ''}".strip())
        return self

    def __exit__(self, *_):
        self.stop.set()
        if self.thread:
            self.thread.join()
        for descriptor in self.taps:
            os.close(descriptor)
        for space in (*hosts.values(), bridge):
            run("ip", "netns", "del", space, check=False)


def session(pack, path, name, timeout_ms=5000, more=()):
    report = folder / f"{name}.json"
    report.unlink(missing_ok=True)
    command = ["ip", "netns", "exec", hosts["render"], program, "measure", "session", str(pack), "--path", str(path), "--size", "256x256",
               "--frames", "60", "--hosts", str(folder / "hosts.toml"), "--timeout", str(timeout_ms), "--json", str(report), *more]
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=240, stdin=subprocess.DEVNULL)
    for space in hosts.values():
        left = run("ip", "netns", "pids", space).split()
        assert not left, f"{name}: processes are left in {space}: {left}"
    assert result.returncode == 0, f"{name}: exit {result.returncode}\n{result.stdout}"
    return json.loads(report.read_text())


def unplugged(pack, path):
    """A session whose switch node 1 has its cable out for many searches, and from the beginning: the render node draws alone,
    every picture is right, and the switch node is taken in once the cable is back. Prints what was drawn."""
    one = [program, "session", str(pack), "--path", str(path), "--size", "256x256", "--frames", "60", "--hash", "--json"]
    right, report = folder / "right.json", folder / "unplugged.json"
    run(*one, str(right))
    report.unlink(missing_ok=True)
    cable = (bridge, "ip", "link", "set", f"t{own[3:]}f3")
    inside(*cable, "down")
    log = open(folder / "unplugged.log", "w+")
    process = subprocess.Popen(
        ["ip", "netns", "exec", hosts["render"], *one, str(report), "--hosts", str(folder / "hosts.toml"), "--until-told", "--rate",
         "60", "--connect-timeout", "0.5"], stdout=log, stderr=log, stdin=subprocess.DEVNULL)

    def wait_for(words, seconds=60):
        give_up = time.monotonic() + seconds
        while words not in (said := (folder / "unplugged.log").read_text()):
            assert process.poll() is None, f"unplugged: the session ended with {process.returncode}\n{said}"
            assert time.monotonic() < give_up, f"unplugged: never said: {words}\n{said}"
            time.sleep(0.05)

    try:
        wait_for("begins alone")
        time.sleep(4)
        inside(*cable, "up")
        wait_for("both switch nodes are here")
        time.sleep(1)
        inside(*cable, "down")
        wait_for("goes on alone")
        time.sleep(6)
        inside(*cable, "up")
        wait_for("both switch nodes are back")
        time.sleep(1)
    finally:
        process.send_signal(signal.SIGTERM)
        code = process.wait(30)
    said = (folder / "unplugged.log").read_text()
    assert code == 0, f"unplugged: exit {code}\n{said}"
    expected, shown = json.loads(right.read_text())["pictures"], json.loads(report.read_text())
    wrong = sum(picture != expected[number % len(expected)] for number, picture in enumerate(shown["pictures"]))
    assert wrong == 0 and shown["digest_mismatches"] == 0, f"unplugged: {wrong} pictures differ\n{said}"
    print(f"unplugged: {shown['frames']} frames, {shown['fallback_frames']} of them by the render node alone, none wrong", flush=True)


def main():
    if os.geteuid() != 0:
        skip("only root may make network namespaces")
    for tool in ("ip", "tc", "nft"):
        if not shutil.which(tool):
            skip(f"{tool} is not installed")
    folder.mkdir(parents=True, exist_ok=True)
    pack = folder / "scene.tpk"
    run(program, "sample", "building", "--floors", "1", "--furniture", "200", "-o", str(folder / "scene"))
    run(program, "build", str(folder / "scene/scene.gltf"), "-o", str(pack))
    key = folder / "key"
    key.unlink(missing_ok=True)
    os.close(os.open(key, os.O_CREAT | os.O_WRONLY, 0o600))
    key.write_text(os.urandom(32).hex() + "\n")
    (folder / "hosts.toml").write_text(
        f'launch = "ip netns exec {own}-{{host}} {{command}}"\nprogram = "{program}"\nkey_file = "{key}"\n'
        f'[render]\naddress = "10.77.0.1:7000"\n[switch_0]\nhost = "zero"\naddress = "10.77.0.2:7001"\n[switch_1]\nhost = "one"\n')
    for name, network in (("lan", Network()), ("relay", Network(delay=0.0001)), ("delay", Network(delay=0.02)), ("loss", Network(loss=1))):
        with network:
            report = session(pack, folder / "scene/walk.json", name)
        frames, delta = report["frames"], report["delta"]
        assert report["identical_frames"] == report["frames_compared"] == frames == 60, f"{name}: pictures differ"
        assert report["digest_mismatches"] == 0, f"{name}: {report['digest_mismatches']} digest mismatches"
        assert report["fallback_frames"] == 0, f"{name}: {report['fallback_frames']} frames by the render node alone"
        share = delta["body_bytes_per_id"] / 4
        latency = report["camera_to_image_ms"]["p50"]
        round_trip = min(socket["round_trip_ms"] for socket in report["traffic"]["sockets"] if "render node" in socket["socket"])
        again = report["traffic"]["retransmissions"]
        print(f"{name}: {frames} frames identical, {delta['body_bytes_per_id']:.2f} body bytes an id ({100 * share:.0f} % of the paper's 4), "
              f"{sum(report['bytes_per_frame'].values()):.0f} bytes a frame, latency {latency:.1f} ms, round trip "
              f"{round_trip:.2f} ms by the kernel, {again:.0f} segments sent again", flush=True)
        assert share <= 0.45, f"{name}: {delta['body_bytes_per_id']} body bytes an id"
        if name == "lan":
            with network:
                unplugged(pack, folder / "scene/walk.json")
        if name == "relay":
            assert round_trip >= 0.2, f"a round trip of {round_trip} ms: the relay is not used"
        if name == "delay":
            assert latency >= 40, f"{latency} ms although each way takes 20 ms: the relay is not used"


main()
