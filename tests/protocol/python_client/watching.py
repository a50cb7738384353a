"""Chapters of a viewer that looks on: pictures, their pace, what they show."""

import asyncio
import math

from checks import JPEG_START, check, check_equal, check_refused, png_size
from visitor import HEIGHT, WIDTH, Visitor


class Watching(Visitor):
    """One method per chapter."""

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
