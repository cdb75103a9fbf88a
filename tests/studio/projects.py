"""Small projects that the tests open: what happens in them is known to the tick."""
import json

# Lines of the script, from 1.
N_LINE, LAST_LINE, EMIT_LINE = 13, 14, 15
SCRIPT = """var n = 0
var last = 0
var speed = 0

timer.period[0] = 10

onevent go
	speed = event.args[0]
	motor.left.target = speed
	motor.right.target = speed

onevent timer0
	n += 1
	last = n * 2
	emit told [n, last]
"""
AESL = """<!DOCTYPE aesl-source>
<network>
<event size="1" name="go"/>
<event size="2" name="told"/>
<keywords flag="true"/>
<node nodeId="{node}" name="{name}"><![CDATA[{script}]]></node>
</network>
"""
DOC = "robot.aesl#1"
ROBOT = {"name": "alice", "type": "thymio2", "at": [0.5, 0.5], "node": 1}


def write(folder, name, content):
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(content if isinstance(content, str) else json.dumps(content, indent=2), encoding="utf-8")
    return path


def thymio(folder, *robots, script=SCRIPT, **more):
    """Thymios in an empty room under one script; `more` goes into vagus.json."""
    write(folder, "robot.aesl", AESL.format(node=1, name="thymio-II", script=script))
    write(folder, "room.world.json", {
        "format": "vagus-world/1", "name": "Room", "size": [3, 3],
        "objects": [{"id": "box", "kind": "box", "at": [2.5, 2.5], "size": [0.2, 0.2]}],
        "robots": [{**robot, "script": "robot.aesl"} for robot in robots or (ROBOT,)]})
    write(folder, "vagus.json", {"format": "vagus-project/1", "name": "Thymio", "scripts": ["robot.aesl"],
                                 "world": "room.world.json", "target": "sim", **more})
    return folder


def bus(folder, target, node=1, name="rover", script=SCRIPT, **more):
    """A script for a node of a bus; `more` goes into vagus.json."""
    write(folder, "robot.aesl", AESL.format(node=node, name=name, script=script))
    write(folder, "vagus.json", {"format": "vagus-project/1", "name": "Rover", "scripts": ["robot.aesl"], "target": target,
                                 **more})
    return folder


# Says a word and waits, again and again; counts its rounds until the limit.
PLAN = {
    "format": "vagus-plan/1", "name": "Rounds",
    "configuration": {"rounds": {"type": "int", "initial": 0}, "limit": {"type": "int", "initial": 1000000}},
    "start": {"actor": "say"},
    "actors": {
        "say": {"template": "Log", "in": {"text": "'round'"}, "states": {"Done": "wait"}},
        "wait": {"template": "Wait", "in": {"seconds": 0.1}, "states": {"Done": "count"}},
        "count": {"template": "Assign", "in": {"value": "rounds + 1"}, "out": {"result": "rounds"}, "states": {"Done": "enough"}},
        "enough": {"template": "Compare", "in": {"left": "rounds", "op": "'>='", "right": "limit"},
                   "states": {"True": "@terminate", "False": "say"}},
    },
}
