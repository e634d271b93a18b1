"""Store the weights of an ONNX file in half precision.

An ONNX file is a protocol-buffers message; this walks only the fields it changes. Float tensors of
the graph become FLOAT16, and so do the declared types of its inputs, outputs and values, which
keeps the file a valid network. The library widens the weights again when it reads them.
"""
import numpy as np

FLOAT, FLOAT16 = 1, 10
GRAPH = 7                                    # of a model
TENSORS, VALUES = 5, (11, 12, 13)            # of a graph: initializers; inputs, outputs, the rest
DATA_TYPE, RAW = 2, 9                        # of a tensor
VARINT, EIGHT_BYTES, COUNTED, FOUR_BYTES = 0, 1, 2, 5


def read_number(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return value, at


def number(value):
    out = bytearray()
    while value > 127:
        out.append(value & 127 | 128)
        value >>= 7
    out.append(value)
    return bytes(out)


def fields(data):
    at = 0
    while at < len(data):
        key, at = read_number(data, at)
        kind = key & 7
        if kind == VARINT:
            value, at = read_number(data, at)
        else:
            size = {EIGHT_BYTES: 8, FOUR_BYTES: 4}.get(kind)
            if size is None:
                size, at = read_number(data, at)
            value = data[at:at + size]
            at += size
        yield key >> 3, kind, value


def rewritten(data, change):
    """The message with every field's value replaced by change(field, value)."""
    out = []
    for field, kind, value in fields(data):
        value = change(field, value)
        out.append(number(field << 3 | kind))
        if kind == VARINT:
            out.append(number(value))
        else:
            out.append((number(len(value)) if kind == COUNTED else b"") + value)
    return b"".join(out)


def half_tensor(data):
    known = {field: value for field, _, value in fields(data)}
    if known.get(DATA_TYPE) != FLOAT:
        return data
    values = np.frombuffer(known[RAW], "<f4").astype("<f2")
    if not np.isfinite(values).all():
        raise SystemExit("a weight is too large for half precision")
    new = {DATA_TYPE: FLOAT16, RAW: values.tobytes()}
    return rewritten(data, lambda field, value: new.get(field, value))


def half_value(data):
    def element(field, value):
        return FLOAT16 if field == 1 and value == FLOAT else value

    def kind(field, value):
        return rewritten(value, element) if field == 1 else value

    return rewritten(data, lambda field, value: rewritten(value, kind) if field == 2 else value)


def half_graph(data):
    def part(field, value):
        return half_tensor(value) if field == TENSORS else half_value(value) if field in VALUES else value

    return rewritten(data, part)


def halved(model):
    """The bytes of an ONNX file -> the bytes of the same network in half precision."""
    return rewritten(model, lambda field, value: half_graph(value) if field == GRAPH else value)
