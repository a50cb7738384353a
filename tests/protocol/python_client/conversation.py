"""Talks to a live sluice-server through every request of the protocol, as a third party's client would.

    conversation.py --server build/release/bin/sluice-server --proto proto --out build/release/python

Exits with 0 when every answer was the one that proto/README.md promises, else with 1 and what was not.
"""

import argparse
import asyncio
import contextlib
import math
import re
import struct
import subprocess
import sys
import tempfile
import traceback

import websockets

import sluice_client
from sluice_client import Client, Refused

WIDTH, HEIGHT = 320, 240
PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
# The least that a server takes for a secret is 16 characters.
TOKEN = "open sesame, open sesame"
JPEG_START = b"\xff\xd8\xff"


@contextlib.contextmanager
def running_server(program, *options):
    """A server on a free port of the loopback; yields the address of its stream."""
    command = [program, "serve", "dam_break", "--listen", "127.0.0.1:0", *options]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        said = []
        for line in process.stdout:
            said.append(line)
            match = re.search(r"listening on http://(\S+?)/?\s*$", line)
            if match:
                yield f"ws://{match[1]}/stream"
                return
        raise RuntimeError("the server did not start:\n" + "".join(said))
    finally:
        process.terminate()
        process.communicate(timeout=30)


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def check_equal(actual, expected, what):
    check(actual == expected, f"{what}: {actual!r}, not {expected!r}")


async def check_refused(answer, code, field_path, what):
    try:
        await answer
    except Refused as refusal:
        check_equal(refusal.error.code, code, f"code of {what}")
        check_equal(refusal.error.field_path, field_path, f"field path of {what}")
        check(refusal.error.message != "", f"{what} is refused without a word")
        return
    raise AssertionError(f"{what} was not refused")


def png_size(data):
    check(data.startswith(PNG_SIGNATURE), "the picture is no PNG")
    return struct.unpack(">II", data[16:24])


class Conversation:
    def __init__(self, scene_pb, pb, address):
        self.scene_pb, self.pb, self.address = scene_pb, pb, address

    async def join(self, **hello):
        client = await Client.connect(self.pb, self.address)
        welcome = await client.ask(hello=self.pb.Hello(client="python-example 1.0", **hello))
        return client, welcome

    async def watch(self, client, codec, **view):
        request = self.pb.SetView(width=WIDTH, height=HEIGHT, codecs=[codec], **view)
        return await client.send(set_view=request)

    def camera_of(self, scene):
        camera = self.scene_pb.Camera()
        camera.CopyFrom(scene.camera)
        return camera

    # -------------------------------------------------------------------------------- one method per chapter

    async def says_hello_first(self):
        client = await Client.connect(self.pb, self.address)
        early = client.ask(ping=self.pb.Ping(client_time=1))
        await check_refused(early, self.pb.Error.REFUSED, "", "a Ping before Hello")
        welcome = await client.ask(hello=self.pb.Hello(client="python-example 1.0"))
        check_equal(welcome.protocol_version, 1, "protocol version")
        check(welcome.viewer_id > 0, "a viewer has a number")
        check_equal(welcome.scene_name, "dam_break", "the scene that runs")
        check("dam_break" in [entry.name for entry in welcome.scenes], "the shipped scenes name the one that runs")
        check({self.pb.JPEG, self.pb.PNG} <= set(welcome.codecs), "JPEG and PNG are always there")
        check(welcome.limits.frame_window > 0, "the window is told")
        check_equal(welcome.role, self.pb.DRIVER, "role without tokens")
        pong = await client.ask(ping=self.pb.Ping(client_time=12.5))
        check_equal(pong.client_time, 12.5, "time that comes back")
        again = client.ask(hello=self.pb.Hello(client="again"))
        await check_refused(again, self.pb.Error.REFUSED, "", "a second Hello")
        await client.close()

    async def watches(self):
        client, welcome = await self.join()
        view = await self.watch(client, self.pb.JPEG, quality=80)
        frame = await client.frame(lambda frame: frame.reflects_sequence >= view)
        check_equal((frame.width, frame.height, frame.codec), (WIDTH, HEIGHT, self.pb.JPEG), "the first picture")
        check(frame.payload.startswith(JPEG_START), "the payload is a JPEG")
        check(frame.keyframe, "the first frame after SetView is a keyframe")
        check(len(frame.stages) > 0, "a frame says where its time went")

        camera = self.camera_of(welcome.scene)
        camera.vertical_fov_degrees = 200
        path = "camera.vertical_fov_degrees"
        moved = client.ask(set_camera=self.pb.SetCamera(camera=camera))
        await check_refused(moved, self.pb.Error.INVALID, path, "a field of view of 200 degrees")
        camera.vertical_fov_degrees = 60
        sequence = await client.send(set_camera=self.pb.SetCamera(camera=camera))
        frame = await client.frame(lambda frame: frame.reflects_sequence >= sequence)
        check(frame.response_milliseconds > 0, "the first frame that shows a camera says how long it took")
        await client.close()

    async def waits_for_acknowledgements(self):
        client, welcome = await self.join()
        await client.ask(control=self.pb.Control(action=self.pb.Control.PLAY))
        await self.watch(client, self.pb.JPEG)
        # It acknowledges nothing, while the simulation makes new pictures all the time.
        await asyncio.sleep(2.0)
        frames = client.waiting_frames()
        check(0 < len(frames) <= welcome.limits.frame_window, f"{len(frames)} frames came without an acknowledgement")
        await client.frame(lambda frame: frame.frame_id > frames[-1].frame_id)
        await client.close()

    async def drives(self):
        client, _ = await self.join()
        await client.ask(control=self.pb.Control(action=self.pb.Control.PAUSE))
        await client.until(lambda: client.stats is not None and client.stats.paused)
        await client.ask(control=self.pb.Control(action=self.pb.Control.RESET))
        await client.until(lambda: client.stats.simulation_time == 0)
        await client.ask(control=self.pb.Control(action=self.pb.Control.STEP, until_seconds=0.02))
        await client.until(lambda: math.isclose(client.stats.simulation_time, 0.02, rel_tol=1e-9))
        check(client.stats.paused, "a step pauses")
        unknown = client.ask(control=self.pb.Control())
        await check_refused(unknown, self.pb.Error.INVALID, "control.action", "a Control without an action")
        await client.close()

    async def changes_the_scene(self):
        client, welcome = await self.join()
        other, _ = await self.join()
        view = await self.watch(client, self.pb.PNG)
        await client.frame(lambda frame: frame.reflects_sequence >= view)

        update = self.pb.UpdateScene()
        update.scene.look.smoothing.time = 2
        update.mask.paths.append("look.smoothing.time")
        sequence = client.next_sequence()
        await client.ask(update_scene=update)
        for viewer in (client, other):
            await viewer.until(lambda: any(c.scene.look.smoothing.time == 2 for c in viewer.scene_changes))
        await client.frame(lambda frame: frame.reflects_sequence >= sequence)

        update.scene.look.smoothing.time = -3
        path = "look.smoothing.time"
        await check_refused(client.ask(update_scene=update), self.pb.Error.INVALID, path, "a negative smoothing time")
        empty = self.pb.UpdateScene()
        await check_refused(client.ask(update_scene=empty), self.pb.Error.INVALID, "mask", "an empty mask")

        name = "double_dam_break"
        await client.ask(load_scene=self.pb.LoadScene(name=name), timeout=60)
        await other.until(lambda: any(c.scene_name == name and c.restarted for c in other.scene_changes))
        missing = client.ask(load_scene=self.pb.LoadScene(name="no_such_scene"))
        await check_refused(missing, self.pb.Error.INVALID, "", "a scene that does not exist")
        await client.ask(load_scene=self.pb.LoadScene(name=welcome.scene_name), timeout=60)
        await client.close()
        await other.close()

    async def takes_a_snapshot(self):
        client, welcome = await self.join()
        request = self.pb.SnapshotRequest(width=200, height=150, camera=self.camera_of(welcome.scene))
        frame = await client.ask(snapshot=request)
        check(frame.snapshot, "the answer to a SnapshotRequest says so")
        check_equal(frame.codec, self.pb.PNG, "a snapshot is lossless")
        check_equal(png_size(frame.payload), (200, 150), "size of the snapshot")
        huge = self.pb.SnapshotRequest(width=welcome.limits.max_width + 1, height=150)
        path = "snapshot.width"
        await check_refused(client.ask(snapshot=huge), self.pb.Error.INVALID, path, "a snapshot beyond the limits")
        await client.close()

    async def rests(self):
        client, _ = await self.join()
        await client.ask(control=self.pb.Control(action=self.pb.Control.PAUSE))
        await self.watch(client, self.pb.JPEG)
        still = await client.frame(lambda frame: frame.still)
        check_equal(png_size(still.payload), (WIDTH, HEIGHT), "the picture at rest")
        await client.close()

    async def picks(self):
        client, welcome = await self.join()
        await client.ask(control=self.pb.Control(action=self.pb.Control.PAUSE))
        await client.ask(control=self.pb.Control(action=self.pb.Control.RESET))
        view = await self.watch(client, self.pb.JPEG)
        await client.frame(lambda frame: frame.reflects_sequence >= view)
        # Straight at the middle of the first block of fluid.
        camera = self.camera_of(welcome.scene)
        block = welcome.scene.simulation.fluids[0].blocks[0]
        spacing = welcome.scene.simulation.particle_spacing
        counts = (block.count_x, block.count_y, block.count_z)
        first = (block.first_particle.x, block.first_particle.y, block.first_particle.z)
        middle = [at + (count - 1) * spacing / 2 for at, count in zip(first, counts)]
        camera.target.x, camera.target.y, camera.target.z = middle
        picked = await client.ask(pick=self.pb.Pick(x=0.5, y=0.5, camera=camera))
        check(picked.hit, "fluid in the middle of the picture")
        eye, at = camera.eye, picked.position
        distance = math.dist((eye.x, eye.y, eye.z), (at.x, at.y, at.z))
        check(abs(distance - picked.depth) < 0.02 * distance, "depth on the view axis is the distance from the eye")
        check(picked.thickness > 2 * spacing, "the block has depth")
        beside = client.ask(pick=self.pb.Pick(x=1.5, y=0.5))
        await check_refused(beside, self.pb.Error.INVALID, "pick.x", "a pick beside the picture")
        camera.target.y = camera.eye.y + 100
        sky = await client.ask(pick=self.pb.Pick(x=0.5, y=0.5, camera=camera))
        check(not sky.hit, "no fluid in the sky")
        await client.close()

    async def touches(self):
        client, welcome = await self.join()
        eye = welcome.scene.camera.eye
        nowhere = self.pb.Interact(action=self.pb.Interact.PUSH, origin=eye)
        path = "interact.direction"
        await check_refused(client.ask(interact=nowhere), self.pb.Error.INVALID, path, "a ray without direction")
        idle = self.pb.Interact(origin=eye, direction=self.scene_pb.Vec3(x=1))
        await check_refused(client.ask(interact=idle), self.pb.Error.INVALID, "interact.action", "a touch of no kind")
        target = welcome.scene.camera.target
        ahead = self.scene_pb.Vec3(x=target.x - eye.x, y=target.y - eye.y, z=target.z - eye.z)
        push = self.pb.Interact(action=self.pb.Interact.PUSH, origin=eye, direction=ahead)
        await client.ask(interact=push)
        await client.close()

    async def follows(self):
        leader, leads = await self.join()
        view = await leader.send(set_view=self.pb.SetView(width=400, height=200, codecs=[self.pb.JPEG]))
        await leader.frame(lambda frame: frame.reflects_sequence >= view)
        follower, _ = await self.join(role=self.pb.SPECTATOR)
        await self.watch(follower, self.pb.JPEG, follow=leads.viewer_id)
        frame = await follower.frame(lambda frame: frame.width == 400)
        check_equal(frame.height, 200, "a follower gets pictures of the other's size")
        play = follower.ask(control=self.pb.Control(action=self.pb.Control.PLAY))
        await check_refused(play, self.pb.Error.REFUSED, "", "a Control of a spectator")
        await leader.until(lambda: any(viewer.follows == leads.viewer_id for viewer in leader.viewers.viewers))
        await leader.close()
        await follower.frame(lambda frame: (frame.width, frame.height) == (WIDTH, HEIGHT))
        await follower.close()

    async def asks_for_a_keyframe(self):
        client, welcome = await self.join()
        video = [codec for codec in welcome.codecs if codec in (self.pb.H264, self.pb.VP9, self.pb.AV1)]
        await client.ask(control=self.pb.Control(action=self.pb.Control.PLAY))
        for codec in video or [self.pb.JPEG]:
            view = await self.watch(client, codec)
            first = await client.frame(lambda frame: frame.reflects_sequence >= view and frame.codec == codec)
            check(first.keyframe, "the first frame after SetView is a keyframe")
            check(codec == self.pb.JPEG or first.decoder != "", "a keyframe of video says how to decode it")
            await client.send(keyframe=self.pb.KeyframeRequest())
            await client.frame(lambda frame: frame.keyframe and not frame.still and frame.frame_id > first.frame_id)
        await client.close()

    async def breaks_the_rules(self):
        client, _ = await self.join()
        again = client.ask(sequence=1, ping=self.pb.Ping())
        await check_refused(again, self.pb.Error.INVALID, "sequence", "a sequence number that does not rise")
        await client.send_bytes(b"\xff\xff\xff")
        check_equal(await client.ended(), 1007, "close code for what is no ClientMessage")


CHAPTERS = (
    "says_hello_first",
    "watches",
    "waits_for_acknowledgements",
    "drives",
    "changes_the_scene",
    "takes_a_snapshot",
    "rests",
    "picks",
    "touches",
    "follows",
    "asks_for_a_keyframe",
    "breaks_the_rules",
)


async def ask_for_tokens(pb, address):
    """A server with a token lets nobody in without it, and takes it by header or by Hello."""
    for header, hello, let_in in (("", "", False), ("", "wrong", False), ("", TOKEN, True), (TOKEN, "", True)):
        client = await Client.connect(pb, address, header)
        try:
            await client.ask(hello=pb.Hello(client="python-example 1.0", token=hello))
            check(let_in, f"{hello!r} was taken for the token")
        except (ConnectionError, Refused):
            check(not let_in, "the token was not taken")
            check_equal(await client.ended(), 1008, "close code without the token")
        await client.close()
    try:
        await Client.connect(pb, address, "wrong")
    except websockets.InvalidStatusCode as refusal:
        check_equal(refusal.status_code, 401, "status of a handshake with a wrong token")
    else:
        raise AssertionError("a handshake with a wrong token was accepted")


async def attempt(name, chapter):
    try:
        await asyncio.wait_for(chapter, 120)
    except Exception:
        print(f"failed: {name}\n{traceback.format_exc()}", flush=True)
        return False
    print(f"holds: {name}", flush=True)
    return True


async def talk(arguments):
    scene_pb, pb = sluice_client.load_messages(arguments.proto, arguments.out, arguments.protoc)
    held = []
    with running_server(arguments.server) as address:
        conversation = Conversation(scene_pb, pb, address)
        for name in CHAPTERS:
            held.append(await attempt(name, getattr(conversation, name)()))
    with tempfile.NamedTemporaryFile("w", suffix=".token") as secret:
        secret.write(TOKEN + "\n")
        secret.flush()
        with running_server(arguments.server, "--token-file", secret.name) as address:
            held.append(await attempt("tokens", ask_for_tokens(pb, address)))
    return all(held)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--server", required=True, help="the sluice-server program")
    parser.add_argument("--proto", required=True, help="folder that holds sluice/v1/*.proto")
    parser.add_argument("--out", required=True, help="folder for the generated messages")
    parser.add_argument("--protoc", default="protoc")
    return 0 if asyncio.run(talk(parser.parse_args())) else 1


if __name__ == "__main__":
    sys.exit(main())
