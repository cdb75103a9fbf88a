"""protocol.json read a second time, from its text alone: what the server sends must be what it promises, and what a fuzzer
sends is well formed up to the last field."""
import json
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROTOCOL = json.loads((ROOT / "src/serve/protocol/protocol.json").read_text(encoding="utf-8"))
COMMANDS, TOPICS, TYPES, LIMITS = (PROTOCOL[key] for key in ("commands", "topics", "types", "limits"))
ODD = [None, True, 0, -1, 1.5, 1e300, "", "x", "../../etc/passwd", "\u0000", [], [0], [[[]]], {}, {"a": {"b": None}}, [0, -1], [1, 70000]]


def split(declared):
    """ "[Point; 64]? -- help" is ("[Point; 64]", may be missing)."""
    kind = declared.split(" -- ")[0].strip()
    return (kind[:-1], True) if kind.endswith("?") else (kind, False)


def parts(kind):
    """ "int(0..9)" is ("int", "0..9"); "[Name; 3]" is ("[", "Name", 3)."""
    if kind[0] in "[{":
        item, _, count = kind[1:-1].rpartition(";")
        return kind[0], item.strip(), int(count)
    found = re.fullmatch(r"([A-Za-z]+)(?:\((.*)\))?", kind)
    return found.group(1), found.group(2), None


def span(text):
    low, _, high = (text or "-1e308..1e308").partition("..")
    return float(low), float(high)


def fault(value, kind, where):
    """What is wrong with a value, or nothing."""
    name, inside, count = parts(kind)
    if name == "[":
        if not isinstance(value, list) or len(value) > count:
            return f"{where}: expected {kind}, found {str(value)[:80]}"
        return next((found for i, item in enumerate(value) if (found := fault(item, inside, f"{where}[{i}]"))), None)
    if name == "{":
        if not isinstance(value, dict) or len(value) > count:
            return f"{where}: expected {kind}, found {str(value)[:80]}"
        return next((found for key, item in value.items() if (found := fault(item, inside, f"{where}.{key}"))), None)
    if name[0].isupper():
        entry = TYPES[name]
        return fault(value, entry["is"], where) if "is" in entry else fault_of_fields(value, entry["fields"], where)
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    good = {
        "json": lambda: True,
        "bool": lambda: isinstance(value, bool),
        "int": lambda: is_number and value == int(value) and span(inside)[0] <= value <= span(inside)[1],
        "number": lambda: is_number and span(inside)[0] <= value <= span(inside)[1],
        "line": lambda: isinstance(value, str) and len(value.encode()) <= int(inside) and "\n" not in value,
        "text": lambda: isinstance(value, str) and len(value.encode()) <= int(inside),
        "word": lambda: value in inside.split("|"),
    }[name]()
    return None if good else f"{where}: expected {kind}, found {json.dumps(value)[:80]}"


def fault_of_fields(value, fields, where):
    if not isinstance(value, dict):
        return f"{where}: expected an object, found {str(value)[:80]}"
    for key, declared in fields.items():
        kind, optional = split(declared)
        if key not in value:
            if not optional:
                return f"{where}.{key}: is missing"
        elif found := fault(value[key], kind, f"{where}.{key}"):
            return found
    extra = set(value) - set(fields)
    return f"{where}: not declared: {sorted(extra)}" if extra else None


def fault_of_document(topic, value):
    return fault_of_fields(value, TOPICS[topic]["is"], topic)


def fault_of_answer(command, value):
    return fault_of_fields(value, COMMANDS[command]["out"], f"answer of {command}")


# ---- inventing ---------------------------------------------------------------------------------


def invented(kind, random, known):
    """A value of a type; `known` has values by name of field or type that mean something."""
    name, inside, count = parts(kind)
    if name in known and random.random() < 0.7:
        return random.choice(known[name])
    if name == "[":
        return [invented(inside, random, known) for _ in range(random.choice([0, 1, 1, 2, min(count, 9)]))]
    if name == "{":
        return {str(i): invented(inside, random, known) for i in range(random.choice([0, 1, 3]))}
    if name[0].isupper():
        entry = TYPES[name]
        return invented(entry["is"], random, known) if "is" in entry else invented_fields(entry["fields"], random, known)
    if name == "json":
        return random.choice(ODD)
    if name == "bool":
        return random.random() < 0.5
    if name in ("int", "number"):
        low, high = span(inside)
        near = [low, high, 0, 1, -1, 2, 65535, 65536, random.uniform(-10, 10), random.uniform(low / 2, high / 2)]
        good = [value for value in near if low <= value <= high]
        return int(random.choice(good)) if name == "int" else random.choice(good)
    if name == "word":
        return random.choice(inside.split("|"))
    return random.choice(["", "x", "a b", "../x", "/etc/passwd", "\u00e9\U0001f916", "x" * min(int(inside), 5000)])[:int(inside) // 4 or 1]


def invented_fields(fields, random, known):
    value = {}
    for key, declared in fields.items():
        kind, optional = split(declared)
        if optional and random.random() < 0.4:
            continue
        value[key] = random.choice(known[key]) if key in known and random.random() < 0.7 else invented(kind, random, known)
    return value
