import { afterEach, beforeEach, expect, test, vi } from "vitest";

import { Backoff } from "../src/protocol/backoff";
import { Connection, streamAddress } from "../src/protocol/connection";
import { FakeServer } from "./fake_socket";

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

function connect() {
  const server = new FakeServer();
  const states: string[] = [];
  const opened = vi.fn();
  const received = vi.fn();
  const connection = new Connection(
    server.make,
    {
      onState: (state, detail) => states.push(detail ? `${state}: ${detail}` : state),
      onOpen: opened,
      onMessage: received,
    },
    new Backoff(400, 1.6, 5000, () => 1),
  );
  connection.start();
  return { server, states, opened, received, connection };
}

test("waits grow up to a bound, are spread, and start afresh after a reset", () => {
  const longest = new Backoff(400, 2, 1500, () => 1);
  expect([longest.next(), longest.next(), longest.next(), longest.next()]).toEqual([400, 800, 1500, 1500]);
  longest.reset();
  expect(longest.next()).toBe(400);
  expect(new Backoff(400, 2, 1500, () => 0).next()).toBe(300);
});

test("a lost connection is opened again, with longer waits until it is confirmed", () => {
  const { server, states, connection } = connect();
  server.newest.accept();
  server.newest.lose();
  expect(states).toEqual(["connecting", "open", "waiting: The connection was lost"]);
  vi.advanceTimersByTime(399);
  expect(server.sockets.length).toBe(1);
  vi.advanceTimersByTime(1);
  expect(server.sockets.length).toBe(2);

  server.newest.lose();
  vi.advanceTimersByTime(639);
  expect(server.sockets.length).toBe(2);
  vi.advanceTimersByTime(1);
  expect(server.sockets.length).toBe(3);

  server.newest.accept();
  connection.confirm();
  server.newest.lose();
  vi.advanceTimersByTime(400);
  expect(server.sockets.length).toBe(4);
});

test("a server that does not answer is given up and tried again", () => {
  const { server } = connect();
  vi.advanceTimersByTime(10_000);
  expect(server.sockets[0]!.closed).toBe(true);
  vi.advanceTimersByTime(400);
  expect(server.sockets.length).toBe(2);
});

test("what a socket says after it was given up is not heard", () => {
  const { server, received, opened, connection } = connect();
  const first = server.newest;
  const { onmessage, onopen } = first;
  connection.drop("silent");
  onopen?.();
  onmessage?.({ data: new ArrayBuffer(3) });
  expect(opened).not.toHaveBeenCalled();
  expect(received).not.toHaveBeenCalled();
});

test("a wait can be ended early, once", () => {
  const { server, connection } = connect();
  server.newest.lose();
  connection.retryNow();
  connection.retryNow();
  expect(server.sockets.length).toBe(2);
  vi.advanceTimersByTime(9_000);
  expect(server.sockets.length).toBe(2);
});

test("a stopped connection stays closed until it is started", () => {
  const { server, connection } = connect();
  server.newest.accept();
  connection.stop();
  expect(server.newest.closed).toBe(true);
  vi.advanceTimersByTime(60_000);
  expect(server.sockets.length).toBe(1);
  expect(connection.send(new Uint8Array(1))).toBe(false);
  connection.start();
  expect(server.sockets.length).toBe(2);
});

test("the close code says why, in words", () => {
  const { server, states } = connect();
  server.newest.accept();
  server.newest.lose(1013);
  expect(states.at(-1)).toBe("waiting: The server has no room for another viewer");
});

test("the stream stands beside the page, encrypted where the page is", () => {
  expect(streamAddress({ protocol: "http:", host: "127.0.0.1:8080" })).toBe("ws://127.0.0.1:8080/stream");
  expect(streamAddress({ protocol: "https:", host: "fluid.example" })).toBe("wss://fluid.example/stream");
});
