"""Chapters of a viewer that takes part: greeting, changing the scene, touching the fluid, breaking the rules."""

import math

from checks import check, check_equal, check_refused
from sluice_client import Client
from visitor import Visitor


class Driving(Visitor):
    """One method per chapter."""

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

    async def breaks_the_rules(self):
        client, _ = await self.join()
        again = client.ask(sequence=1, ping=self.pb.Ping())
        await check_refused(again, self.pb.Error.INVALID, "sequence", "a sequence number that does not rise")
        await client.send_bytes(b"\xff\xff\xff")
        check_equal(await client.ended(), 1007, "close code for what is no ClientMessage")
