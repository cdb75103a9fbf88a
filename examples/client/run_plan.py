#!/usr/bin/python3
"""Runs a plan in the studio and prints what happens: a client of your own, in Python.

The studio's server speaks JSON over a WebSocket; docs/protocol.md lists every command and every topic. Start it, and give
this program the address that it prints:

    vagus studio --example patterns
    python3 run_plan.py 'http://127.0.0.1:8910/#token=…' --speed 20

It needs the Debian package python3-websockets. It takes control in the studio; a browser that is open meanwhile can only view.
It ends with the plan: exit status 0 if the plan's result was OK, else 1.
"""
import argparse
import asyncio
import json
import secrets
import sys
import urllib.parse

import websockets


async def run_plan(address, speed):
    url = urllib.parse.urlsplit(address)
    token = url.fragment.removeprefix("token=")
    scheme = {"http": "ws", "https": "wss"}[url.scheme]
    # Without compression, and with room for documents: the server sends them whole once, then patches.
    async with websockets.connect(f"{scheme}://{url.netloc}/live", subprotocols=["vagus-1"], origin=f"{url.scheme}://{url.netloc}",
                                  compression=None, max_size=None) as live:
        # Each command has a number; its answer, { "id": …, "ok": … } or { "id": …, "error": … }, comes when it is done.
        # One that comes twice with one number is done once, for clients that repeat it after a lost connection.
        # What can move a robot has a deadline, 3 s after it was wanted, in the server's time, which the answer to hello tells.
        commands = [("hello", {"token": token, "client": secrets.token_hex(8), "name": "run_plan.py"}),
                    ("driver.ask", {}),
                    ("watch", {"watch": 1, "topic": "plan", "rate": 60}),
                    ("watch", {"watch": 2, "topic": "happenings", "of": {"kinds": ["event", "fault"]}}),
                    ("clock.speed", {"speed": speed}),
                    ("run.start", {})]
        names = dict(enumerate((name for name, _ in commands), start=1))
        await live.send(json.dumps({"id": 1, "do": "hello", "in": commands[0][1]}))

        plan, told, begun = {}, 0, False
        async for text in live:
            message = json.loads(text)
            if "error" in message:
                sys.exit(f"{names[message['id']]}: {message['error']['what']}")
            if "ping" in message:  # each second; it says the server's time, too
                await live.send(json.dumps({"pong": message["ping"]}))
            if message.get("id") == 1:  # welcome: all others now
                for number, (name, fields) in enumerate(commands[1:], start=2):
                    await live.send(json.dumps({"id": number, "do": name, "in": fields, "until": message["ok"]["now"] + 3000}))
            if message.get("id") == len(commands):
                begun = True  # what came before was of an earlier run
            if message.get("watch") == 2 and begun:  # a stream: items
                for item in message["items"]:
                    print(f"{item['t']:9.3f}  {item['source']}: {item['name']} {' '.join(map(str, item['args']))} {item['text']}")
            if message.get("watch") == 1:  # a document: whole, then patches (RFC 7396), here of its top level
                plan.update(message.get("whole") or message["patch"])
                for line in plan["story"] if begun else []:
                    if line["number"] >= told:
                        told = line["number"] + 1
                        print(f"{line['t']:9.3f}  {line['text']}")
                if begun and plan["state"] == "ended":
                    await live.send(json.dumps({"id": len(commands) + 1, "do": "driver.leave"}))
                    return plan["result"]


if __name__ == "__main__":
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("address", help="that `vagus studio` has printed")
    options.add_argument("--speed", type=float, default=1, help="of a simulation, against the wall clock; 0: as fast as it goes")
    given = options.parse_args()
    sys.exit(0 if asyncio.run(run_plan(given.address, given.speed)) == "OK" else 1)
