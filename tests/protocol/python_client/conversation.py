"""Talks to a live sluice-server through every request of the protocol, as a third party's client would.

    conversation.py --server build/release/bin/sluice-server --proto proto --out build/release/python

Exits with 0 when every answer was the one that proto/README.md promises, else with 1 and what was not.
"""

import argparse
import asyncio
import contextlib
import re
import subprocess
import sys
import tempfile
import traceback

import websockets

import sluice_client
from checks import check, check_equal
from driving import Driving
from sluice_client import Client, Refused
from watching import Watching

# The least that a server takes for a secret is 16 characters.
TOKEN = "open sesame, open sesame"


class Conversation(Watching, Driving):
    """Every chapter there is."""


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
