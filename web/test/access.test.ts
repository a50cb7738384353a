import { expect, test, vi } from "vitest";

vi.stubGlobal("document", { createElement: vi.fn() });
const { splitFragment } = await import("../src/ui/access");

test("the fragment gives its token, decoded, and keeps everything else", () => {
  expect(splitFragment("#token=a%20b&x=1")).toEqual({ token: "a b", rest: "x=1" });
  expect(splitFragment("#x=1")).toEqual({ token: undefined, rest: "x=1" });
  expect(splitFragment("")).toEqual({ token: undefined, rest: "" });
  expect(splitFragment("#token=100%")).toEqual({ token: "100%", rest: "" });
});
