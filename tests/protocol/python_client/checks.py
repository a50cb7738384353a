"""What a test of the protocol says of an answer that is not the promised one."""

import struct

from sluice_client import Refused

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
JPEG_START = b"\xff\xd8\xff"


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
