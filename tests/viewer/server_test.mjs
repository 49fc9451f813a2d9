// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// What the server of `ridgeway view` answers to those who mean it well, and to those who do not.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import net from "node:net";
import test, { after, before } from "node:test";
import { rooms, run, run_json, view } from "./program.mjs";

let served;
let map;
before(async () => {
  map = rooms();
  served = await view(map);
});
after(() => served.stop());

const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Whether something comes before so many milliseconds are over. */
async function comes(promise, ms) {
  let timer;
  const over = new Promise((resolve) => (timer = setTimeout(resolve, ms, false)));
  const has_come = await Promise.race([promise.then(() => true), over]);
  clearTimeout(timer);
  return has_come;
}

/** Sends bytes as they are; the answer as text, once the connection is closed. */
function send(bytes, { wait = 10_000 } = {}) {
  return new Promise((resolve) => {
    const socket = net.connect(served.port, "127.0.0.1");
    let answer = "";
    const end = () => resolve(answer);
    socket.on("data", (part) => (answer += part.toString("latin1")));
    socket.on("close", end);
    socket.on("error", end);
    socket.setTimeout(wait, () => socket.destroy());
    socket.write(bytes);
  });
}
const get = (path, headers = "") => send(`GET ${path} HTTP/1.1\r\nHost: 127.0.0.1:${served.port}\r\n${headers}\r\n`);
const status = (answer) => Number(/^HTTP\/1\.[01] (\d+)/.exec(answer)?.[1] ?? 0);
const ask = async (path) => {
  const response = await fetch(served.address + path);
  return { status: response.status, body: await response.json() };
};
const memory = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${served.server.pid}/status`, "utf8"))[1]) / 1024;

async function still_answers() {
  assert.equal(served.server.exitCode, null, "the server has ended");
  assert.equal(status(await get("/api/info")), 200);
}

test("plans as the command line does", async () => {
  const { body } = await ask("api/plan?from=-2,0.3,1&to=2,-0.5,1");
  const plan = run_json("plan", map, "--from=-2,0.3,1", "--to=2,-0.5,1");
  assert.equal(body.status, "ok");
  assert.deepEqual(body.waypoints, plan.waypoints);
  assert.equal(body.length, plan.length);
  const several = await ask("api/plan?from=-2,0.3,1&to=2,-0.5,1&alternatives=3");
  const routes = run_json("plan", map, "--from=-2,0.3,1", "--to=2,-0.5,1", "--alternatives", "3").routes;
  assert.deepEqual(several.body.routes.map((r) => r.length), routes.map((r) => r.length));
  const flown = await ask("api/trajectory?from=-2,0.3,1&to=2,-0.5,1&max_speed=1");
  assert.equal(flown.body.status, "ok");
  assert.ok(flown.body.duration > plan.length);
});

test("flies along a path that is given, if it is free", async () => {
  const path = "-2,0.3,1;0.05,0,1.2;2,-0.5,1";
  const { body } = await ask(`api/trajectory?path=${encodeURIComponent(path)}&max_speed=1`);
  assert.equal(body.status, "ok");
  const places = path.split(";").map((place) => place.split(",").map(Number));
  const nearest = (place) => Math.min(...body.samples.map((s) => Math.hypot(...s.position.map((x, i) => x - place[i]))));
  for (const place of places) assert.ok(nearest(place) < 0.3, `${place} is passed at ${nearest(place)} m`);
  const blocked = (await ask("api/trajectory?path=-2,1.5,1;2,1.5,1")).body;
  assert.notEqual(blocked.status, "ok");
  assert.match(blocked.reason, /not free/);
});

test("tells why there is no route, and where", async () => {
  const { body } = await ask("api/plan?from=-2,0,1&to=2,0,1&radius=0.8");
  assert.equal(body.status, "no_route");
  assert.match(body.reason, /not connected at a radius of 0.8 m/);
  assert.ok(Math.abs(body.blocked.radius - 0.6) < 0.06);
  assert.ok(Math.abs(body.blocked.place[0]) < 0.3);
  assert.equal((await ask("api/plan?from=-2,0,1&to=2,0,1&radius=0.8&explain=0")).body.reason, undefined);
  for (const several of ["", "&alternatives=2"]) {
    const moved = (await ask(`api/plan?from=-2,1.5,1&to=2,0,1&radius=0.8&snap=1${several}`)).body;
    assert.match(moved.reason, /not connected at a radius of 0.8 m .*but they are at/);
    assert.ok(Math.abs(moved.blocked.radius - 0.6) < 0.06);
  }
});

test("refuses parameters that are misspelt, given twice or of another answer", async () => {
  const query = "from=-2,0.3,1&to=2,-0.5,1";
  for (const [path, word] of [[`api/plan?${query}&raduis=0.6`, "raduis"], [`api/plan?${query}&from=0,0,0`, "from.*twice"], [`api/plan?${query}&escape=2`, "escape"], [`api/plan?${query}&explain=no`, "explain"], [`api/plan?${query}&max_speed=1`, "max_speed"], ["api/info?at=0,0,0", "at"], ["api/slice?z=1&radius=2", "radius"]]) {
    const { status: code, body } = await ask(path);
    assert.equal(code, 400, path);
    assert.match(body.error, new RegExp(word), path);
  }
});

test("serves nothing but its page and its answers", async () => {
  for (const path of ["/../../etc/passwd", "/../etc/passwd", "//etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc%2fpasswd", "/page.js/../../../etc/passwd", "/page.js%00.html", "/etc/passwd", "/api/../../etc/passwd", "/rooms.ridge", "/api/", "/api/info/x", "/.", "/\\..\\..", `/${encodeURIComponent(map)}`, "file:///etc/passwd"]) {
    const answer = await get(path);
    assert.ok(status(answer) >= 400 && status(answer) < 500, `${path}: ${answer.slice(0, 100)}`);
    assert.doesNotMatch(answer, /root:|RIDGEWAY/);
  }
  for (const path of ["/", "/index.html", "/page.js", "/page.css"]) assert.equal(status(await get(path)), 200, path);
  await still_answers();
});

test("sends its page as it is, so that nobody waits until it is packed", async () => {
  for (const path of ["/", "/page.js", "/page.css", "/api/graph"]) {
    const plain = await get(path);
    for (const coding of ["gzip", "br", "gzip, deflate, br"]) {
      const answer = await get(path, `Accept-Encoding: ${coding}\r\n`);
      assert.doesNotMatch(answer.slice(0, answer.indexOf("\r\n\r\n")), /Content-Encoding/i, `${path} ${coding}`);
      assert.equal(answer.length, plain.length, `${path} ${coding}`);
    }
  }
});

test("streams nothing of a map that does not change", async () => {
  const { status: code, body } = await ask("api/live");
  assert.equal(code, 404);
  assert.match(body.error, /does not change.*live --view/);
});

test("answers its own page alone", async () => {
  const at = `127.0.0.1:${served.port}`;
  const cases = [
    [`Host: evil.example\r\n`, 403],
    [`Host: evil.example:${served.port}\r\n`, 403],
    [`Host: 127.0.0.1\r\n`, 403],
    [`Host: 127.0.0.1:1\r\n`, 403],
    [`Host: ${at}.evil.example\r\n`, 403],
    [`Host: \r\n`, 403],
    [``, 403],
    [`Host: ${at}\r\nHost: evil.example\r\n`, 403],
    [`Host: ${at}\r\nOrigin: http://evil.example\r\n`, 403],
    [`Host: ${at}\r\nOrigin: null\r\n`, 403],
    [`Host: ${at}\r\nOrigin: https://${at}\r\n`, 403],
    [`Host: ${at}\r\nOrigin: http://${at}.evil.example\r\n`, 403],
    [`Host: ${at}\r\nSec-Fetch-Site: cross-site\r\n`, 403],
    [`Host: ${at}\r\nSec-Fetch-Site: same-site\r\n`, 403],
    [`Host: ${at}\r\nOrigin: http://${at}\r\nOrigin: http://evil.example\r\n`, 403],
    [`Host: ${at}\r\nSec-Fetch-Site: none\r\nSec-Fetch-Site: cross-site\r\n`, 403],
    [`Host: ${at}\r\nOrigin: http://${at}\r\nSec-Fetch-Site: same-origin\r\n`, 200],
    [`Host: localhost:${served.port}\r\n`, 200],
  ];
  for (const [headers, expected] of cases) {
    const answer = await send(`GET /api/info HTTP/1.1\r\n${headers}\r\n`);
    assert.equal(status(answer), expected, `${headers}: ${answer.slice(0, 200)}`);
    if (expected !== 200) assert.doesNotMatch(answer, /voxel_size/);
  }
});

test("opens for a person who follows a link elsewhere, and for no other page's script", async () => {
  const from_elsewhere = (path, mode, destination) =>
    send(`GET ${path} HTTP/1.1\r\nHost: 127.0.0.1:${served.port}\r\nSec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: ${mode}\r\nSec-Fetch-Dest: ${destination}\r\n\r\n`);
  assert.equal(status(await from_elsewhere("/", "navigate", "document")), 200);
  for (const [path, mode, destination] of [
    ["/", "navigate", "iframe"], ["/", "no-cors", "script"], ["/", "cors", "empty"], ["/api/info", "navigate", "document"], ["/api/surface", "no-cors", "image"],
  ])
    assert.equal(status(await from_elsewhere(path, mode, destination)), 403, `${path} ${mode} ${destination}`);
});

test("is bound to this machine alone", () => {
  const hex = served.port.toString(16).toUpperCase().padStart(4, "0");
  const listening = ["tcp", "tcp6"].flatMap((file) => readFileSync(`/proc/net/${file}`, "utf8").split("\n"))
    .map((line) => line.trim().split(/\s+/)).filter((words) => words[3] === "0A" && words[1].endsWith(`:${hex}`));
  assert.deepEqual(listening.map((words) => words[1]), [`0100007F:${hex}`]);
});

test("refuses other methods and all bodies", async () => {
  for (const method of ["POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "BREW"]) {
    const answer = await send(`${method} /api/info HTTP/1.1\r\nHost: 127.0.0.1:${served.port}\r\nContent-Length: 0\r\n\r\n`);
    assert.ok(status(answer) >= 400, `${method}: ${answer.slice(0, 100)}`);
  }
  const put = await send(`PUT /api/info HTTP/1.1\r\nHost: 127.0.0.1:${served.port}\r\nContent-Length: 0\r\n\r\n`);
  assert.equal(status(put), 405);
  assert.match(put, /\r\nAllow: GET, HEAD\r\n/);
  const head = await send(`HEAD /api/info HTTP/1.1\r\nHost: 127.0.0.1:${served.port}\r\n\r\n`);
  assert.equal(status(head), 200);
  assert.doesNotMatch(head, /voxel_size/);
});

test("bounds what it takes in", async () => {
  const before = memory();
  const host = `Host: 127.0.0.1:${served.port}\r\n`;
  const attacks = {
    "a long address": `GET /${"a".repeat(100_000)} HTTP/1.1\r\n${host}\r\n`,
    "a long query": `GET /api/plan?from=${"1".repeat(20_000)} HTTP/1.1\r\n${host}\r\n`,
    "a long header": `GET / HTTP/1.1\r\n${host}X: ${"a".repeat(1_000_000)}\r\n\r\n`,
    "many headers": `GET / HTTP/1.1\r\n${host}${"X: y\r\n".repeat(300_000)}\r\n`,
    "a large body": `POST / HTTP/1.1\r\n${host}Content-Length: 20000000\r\n\r\n${"a".repeat(20_000_000)}`,
    "an impossible body": `POST / HTTP/1.1\r\n${host}Content-Length: 99999999999999999999\r\n\r\n`,
    "a negative body": `POST / HTTP/1.1\r\n${host}Content-Length: -1\r\n\r\nabc`,
    "endless chunks": `POST / HTTP/1.1\r\n${host}Transfer-Encoding: chunked\r\n\r\n${"5\r\nabcde\r\n".repeat(500_000)}`,
  };
  for (const [name, bytes] of Object.entries(attacks)) {
    const answer = await send(bytes);
    assert.ok(status(answer) === 0 || status(answer) >= 400, `${name}: ${answer.slice(0, 100)}`);
    await still_answers();
  }
  assert.ok(memory() - before < 50, `memory has grown from ${before} to ${memory()} MB`);
});

test("takes nonsense for what it is", async () => {
  const host = `Host: 127.0.0.1:${served.port}\r\n`;
  for (const bytes of ["\0\0\0\0\r\n\r\n", "GET\r\n\r\n", "GET /\r\n\r\n", `GET / HTTP/9.9\r\n${host}\r\n`, `GET /%zz%1 HTTP/1.1\r\n${host}\r\n`, "\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03".repeat(20) + "\r\n\r\n", `GET / HTTP/1.1\r\n: \r\n${host}\r\n`, `GET / HTTP/1.1\nHost: x\n\n`, "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", `GET / HTTP/1.1\r\n${host}Range: bytes=999999999-\r\n\r\n`, `GET /api/info HTTP/1.1\r\n${host}Range: bytes=5-1\r\n\r\n`, `GET / HTTP/1.1\r\n${host}Expect: 100-continue\r\n\r\n`]) {
    await send(bytes, { wait: 7000 });
    await still_answers();
  }
});

test("sends no byte beyond the end of an answer, whatever range is asked for", async () => {
  for (const path of ["/", "/page.js", "/api/info", "/api/graph"]) {
    const whole = await get(path);
    const body = (answer) => answer.slice(answer.indexOf("\r\n\r\n") + 4);
    for (const range of ["0-9", "-5", "0-99999999", "99999999-", "0-99999999,0-99999999", "99999999-100000000", "0-1,3-4"]) {
      const answer = await get(path, `Range: bytes=${range}\r\n`);
      assert.equal(status(answer), 200, `${path} ${range}: ${answer.slice(0, 200)}`);
      assert.equal(body(answer), body(whole), `${path} ${range}`);
    }
  }
});

test("names the parameter that it cannot use", async () => {
  const cases = {
    "api/plan": "from", "api/plan?from=1,2": "from", "api/plan?from=0,0,nan&to=1,1,1": "from", "api/plan?from=0,0,1&to=1e999,0,0": "to",
    "api/plan?from=-2,0,1&to=2,0,1&radius=-1": "radius", "api/plan?from=-2,0,1&to=2,0,1&radius=nan": "radius", "api/plan?from=-2,0,1&to=2,0,1&radius=1e-320": "radius",
    "api/plan?from=-2,0,1&to=2,0,1&planner=magic": "planner", "api/plan?from=-2,0,1&to=2,0,1&planner=rrtstar": "planner",
    "api/plan?from=-2,0,1&to=2,0,1&alternatives=1000000000": "alternatives", "api/plan?from=-2,0,1&to=2,0,1&alternatives=-1": "alternatives",
    "api/plan?from=-2,0,1&to=2,0,1&snap=-1": "snap", "api/plan?from=-2,0,1&to=2,0,1&prefer_clearance=inf": "prefer_clearance",
    "api/trajectory?from=-2,0,1&to=2,0,1&max_speed=0": "max_speed", "api/trajectory?path=": "path", "api/trajectory?path=1,2": "path", "api/trajectory?path=0,0,1;": "path", "api/trajectory?path=0,0,1;1e9,0,0": "path", "api/components": "of", "api/components?of=gvd": "of", "api/slice": "z", "api/slice?z=nan": "z", "api/slice?z=1e300": "z", "api/section": "z", "api/section?z=nan": "z", "api/section?z=1e300": "z",
    "api/place?at=1e9,0,0": "at", "api/place?at=%00": "at",
  };
  for (const [path, name] of Object.entries(cases)) {
    const { status, body } = await ask(path);
    assert.equal(status, 400, `${path}: ${JSON.stringify(body)}`);
    assert.ok(body.error.startsWith(name), `${path}: ${body.error}`);
  }
  const far = await ask("api/plan?from=1e8,0,1&to=2,0,1");
  assert.equal(far.body.status, "start_outside_map");
});

test("answers fifty at once, all alike", async () => {
  const paths = ["api/surface", "api/graph", "api/diagram", "api/narrow", "api/gvd"];
  const answers = await Promise.all(Array.from({ length: 50 }, async (_, i) => {
    const response = await fetch(`${served.address}${paths[i % paths.length]}`);
    const plan = await fetch(`${served.address}api/plan?from=-2,0,1&to=2,${(i % 10) / 10},1`);
    return [response.status, plan.status, Buffer.from(await response.arrayBuffer()).toString("base64"), (await plan.json()).status];
  }));
  for (const [i, [layer, plan, bytes, planned]] of answers.entries()) {
    assert.deepEqual([layer, plan, planned], [200, 200, "ok"]);
    assert.equal(bytes, answers[i % paths.length][2]);
  }
});

test("keeps those who come while it is busy", async () => {
  served.server.kill("SIGSTOP");
  const many = Array.from({ length: 100 }, () => net.connect(served.port, "127.0.0.1").on("error", () => {}));
  // For whom there is no room, there is no answer, and the kernel tries again after a second, two, four.
  const come = await Promise.all(many.map((socket) => comes(new Promise((resolve) => socket.on("connect", resolve)), 5000)));
  served.server.kill("SIGCONT");
  for (const socket of many) socket.destroy();
  assert.equal(come.filter((has_come) => has_come).length, many.length);
  await still_answers();
});

test("is not held up by the slow", async () => {
  const before = memory();
  const slow = Array.from({ length: 50 }, (_, i) => {
    const socket = net.connect(served.port, "127.0.0.1");
    socket.on("error", () => {});
    socket.gone = new Promise((resolve) => socket.on("close", resolve));
    // Half send a byte now and then, half ask for much and read nothing.
    if (i % 2 === 0) socket.timer = setInterval(() => socket.write("G"), 300);
    else socket.pause().write(`GET /page.js HTTP/1.1\r\nHost: 127.0.0.1:${served.port}\r\n\r\n`);
    return socket;
  });
  await sleep(300);
  for (let i = 0; i < 10; ++i) await still_answers();
  // A request that is not whole in five seconds is given up, however busily it is sent.
  const ends = await Promise.all(slow.filter((socket) => socket.timer).map((socket) => comes(socket.gone, 60_000)));
  assert.ok(ends.every((is_closed) => is_closed), "a slow request is never given up");
  for (const socket of slow) {
    clearInterval(socket.timer);
    socket.destroy();
  }
  assert.ok(memory() - before < 60, `memory has grown from ${before} to ${memory()} MB`);
  await still_answers();
});

test("ends by Ctrl-C, with clients connected", async () => {
  const other = await view(map);
  const idle = net.connect(other.port, "127.0.0.1");
  idle.on("error", () => {});
  await sleep(200);
  const { code } = await other.stop();
  assert.equal(code, 130);
  idle.destroy();
});

test("says which port cannot be had, and what is no roadmap", () => {
  const taken = run("view", map, "--port", String(served.port));
  assert.equal(taken.status, 1);
  assert.match(taken.stderr, /--port \d+: cannot be had/);
  const none = run("view", "/etc/hostname");
  assert.equal(none.status, 1);
  assert.match(none.stderr, /is no \.ridge file/);
});
