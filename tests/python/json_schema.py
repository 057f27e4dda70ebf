"""As much of JSON Schema as docs/schema/ uses, from the standard library alone.

A keyword that is not known is an error: a schema that says more than is checked would be worth nothing.
"""

_TYPES = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "null": type(None),
}
_KNOWN = {
    "$schema", "$defs", "title", "description", "type", "properties", "required", "additionalProperties", "items",
    "const", "enum", "anyOf", "minimum", "$ref",
}


def _is(value, name):
    if name in ("number", "integer"):
        whole = isinstance(value, int) or (isinstance(value, float) and value.is_integer())
        return not isinstance(value, bool) and (isinstance(value, float) or whole if name == "number" else whole)
    return isinstance(value, _TYPES[name])


def faults(value, schema, root=None, path="$"):
    """Why `value` is not as the schema says, one sentence each; empty if it is."""
    root = root or schema
    unknown = set(schema) - _KNOWN
    if unknown:
        raise ValueError(f"the schema at {path} has keywords that are not checked: {sorted(unknown)}")
    if "$ref" in schema:
        return faults(value, root["$defs"][schema["$ref"].removeprefix("#/$defs/")], root, path)
    found = []
    if "anyOf" in schema and all(faults(value, one, root, path) for one in schema["anyOf"]):
        found.append(f"{path} is none of what it may be")
    if "const" in schema and value != schema["const"]:
        found.append(f"{path} is {value!r}, expected {schema['const']!r}")
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{path} is {value!r}, expected one of {schema['enum']}")
    types = schema.get("type", [])
    types = [types] if isinstance(types, str) else types
    if types and not any(_is(value, name) for name in types):
        return found + [f"{path} is a {type(value).__name__}, expected {' or '.join(types)}"]
    if "minimum" in schema and value < schema["minimum"]:
        found.append(f"{path} is {value}, expected at least {schema['minimum']}")
    if isinstance(value, dict):
        found += _faults_of_object(value, schema, root, path)
    if isinstance(value, list) and "items" in schema:
        for index, item in enumerate(value):
            found += faults(item, schema["items"], root, f"{path}[{index}]")
    return found


def _faults_of_object(value, schema, root, path):
    known = schema.get("properties", {})
    found = [f"{path} has no {key!r}" for key in schema.get("required", []) if key not in value]
    others = schema.get("additionalProperties", True)
    for key, item in value.items():
        if key in known:
            found += faults(item, known[key], root, f"{path}.{key}")
        elif others is False:
            found.append(f"{path} has {key!r}, which the schema does not know")
        elif isinstance(others, dict):
            found += faults(item, others, root, f"{path}.{key}")
    return found
