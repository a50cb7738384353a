"""A third party's viewer of a server, from which the chapters of the conversation are made."""

from sluice_client import Client

WIDTH, HEIGHT = 320, 240


class Visitor:
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
