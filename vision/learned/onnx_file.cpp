#include "vision/learned/onnx_file.h"

#include "base/error.h"
#include "vision/learned/onnx_tensor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>

// Field numbers are those of onnx.proto (ONNX IR version 3 and later).
namespace scree::vision {
namespace {

constexpr std::size_t kMostParts = 4096;
constexpr std::int64_t kMostInteger = 65536;

constexpr std::string_view kOperators[] = {
    "Conv",     "Relu",     "LeakyRelu", "Sigmoid", "Clip",        "MaxPool",
    "Resize",   "Concat",   "Add",       "Mul",     "AveragePool", "BatchNormalization",
    "Constant", "Upsample", "Identity"};

std::int64_t modest(std::int64_t value) {
    if (value < -kMostInteger || value > kMostInteger)
        fail<InvalidInput>("one of its operators has the parameter ", value);
    return value;
}

float finite_bits(std::uint64_t bits) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    if (!std::isfinite(value))
        fail<InvalidInput>("one of its operators has a parameter that is no finite number");
    return value;
}

void copy_floats(const WireField& field, std::string& out) {
    if (field.wire == Wire::Fixed32) {
        put_float(out, 7, finite_bits(field.value));
        return;
    }
    const std::string_view bytes = message_of(field);
    for (std::size_t at = 0; at + 4 <= bytes.size(); at += 4) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, bytes.data() + at, sizeof bits);
        put_float(out, 7, finite_bits(bits));
    }
}

std::string copied_attribute(std::string_view message) {
    std::string out;
    for (const WireField& field : wire_fields(message)) {
        switch (field.number) {
            case 1:
                put_bytes(out, 1, text_of(field));
                break;
            case 2:
                put_float(out, 2, finite_bits(field.value));
                break;
            case 3:
                modest(static_cast<std::int64_t>(field.value));
                put_varint(out, 3, field.value);
                break;
            case 4:
                put_bytes(out, 4, text_of(field));
                break;
            case 5:
                put_bytes(out, 5, written(read_tensor(message_of(field))));
                break;
            case 7:
                copy_floats(field, out);
                break;
            case 8: {
                std::vector<std::int64_t> values;
                append_varints(field, values);
                for (const std::int64_t value : values)
                    put_varint(out, 8, static_cast<std::uint64_t>(modest(value)));
                break;
            }
            case 13:
                break;  // remark
            case 20:
                put_varint(out, 20, field.value);
                break;
            default:
                fail<InvalidInput>("one of its operators has parameters of a foreign kind");
        }
    }
    return out;
}

struct Node {
    std::vector<std::string> inputs, outputs;
    std::string type;
    std::vector<std::string> attributes;
};

Node read_node(std::string_view message) {
    Node node;
    for (const WireField& field : wire_fields(message)) {
        switch (field.number) {
            case 1:
                node.inputs.emplace_back(text_of(field));
                break;
            case 2:
                node.outputs.emplace_back(text_of(field));
                break;
            case 4:
                node.type = text_of(field);
                break;
            case 5:
                node.attributes.push_back(copied_attribute(message_of(field)));
                break;
            case 7:
                if (!text_of(field).empty() && text_of(field) != "ai.onnx")
                    fail<InvalidInput>("it has operators of the foreign family '", text_of(field),
                                       "'");
                break;
            default:
                break;  // name and remarks
        }
    }
    if (std::find(std::begin(kOperators), std::end(kOperators), node.type) == std::end(kOperators))
        fail<InvalidInput>("it has the operator '", node.type, "', which no outline network needs");
    return node;
}

struct Graph {
    std::vector<Node> nodes;
    std::vector<OnnxTensor> weights;
    std::vector<std::string> inputs, outputs;
    std::vector<std::int64_t> input_dims;  // of the last input; 0 where not fixed
};

// ValueInfoProto: name, type { tensor_type { shape { dim } } }.
std::string read_value(std::string_view message, std::vector<std::int64_t>& dims) {
    std::string name;
    const auto inner = [](std::string_view outer, unsigned number) {
        for (const WireField& field : wire_fields(outer))
            if (field.number == number)
                return message_of(field);
        return std::string_view();
    };
    for (const WireField& field : wire_fields(message)) {
        if (field.number == 1)
            name = text_of(field);
        if (field.number != 2)
            continue;
        dims.clear();
        for (const WireField& dim : wire_fields(inner(inner(message_of(field), 1), 2))) {
            dims.push_back(0);
            for (const WireField& value : wire_fields(message_of(dim)))
                if (value.number == 1)
                    dims.back() = static_cast<std::int64_t>(value.value);
        }
    }
    return name;
}

Graph read_graph(std::string_view message) {
    Graph graph;
    std::vector<std::int64_t> ignored;
    std::vector<std::pair<std::string, std::vector<std::int64_t>>> inputs;
    for (const WireField& field : wire_fields(message)) {
        switch (field.number) {
            case 1:
                graph.nodes.push_back(read_node(message_of(field)));
                break;
            case 5:
                graph.weights.push_back(read_tensor(message_of(field)));
                break;
            case 11: {
                std::vector<std::int64_t> dims;
                const std::string name = read_value(message_of(field), dims);
                inputs.emplace_back(name, dims);
                break;
            }
            case 12:
                graph.outputs.push_back(read_value(message_of(field), ignored));
                break;
            case 15:
                fail<InvalidInput>("it has sparse weights");
            default:
                break;  // names, shapes in between and remarks
        }
        if (graph.nodes.size() + graph.weights.size() + inputs.size() > kMostParts)
            fail<InvalidInput>("it has more than ", kMostParts, " operators and weights");
    }
    for (const auto& [name, dims] : inputs) {  // older files list the weights among the inputs
        const bool weight =
            std::any_of(graph.weights.begin(), graph.weights.end(),
                        [&, &n = name](const OnnxTensor& t) { return t.name == n; });
        if (!weight) {
            graph.inputs.push_back(name);
            graph.input_dims = dims;
        }
    }
    return graph;
}

const OnnxTensor* find_weight(const Graph& graph, const std::string& name) {
    for (const OnnxTensor& tensor : graph.weights)
        if (tensor.name == name)
            return &tensor;
    return nullptr;
}

void check_convolution(const Graph& graph, const Node& node) {
    const OnnxTensor* weights =
        node.inputs.size() < 2 ? nullptr : find_weight(graph, node.inputs[1]);
    if (weights == nullptr || weights->type != kOnnxFloat || weights->dims.size() != 4)
        fail<InvalidInput>("a convolution of it has no weights of four dimensions");
    const auto& dims = weights->dims;
    if (dims[0] > 4096 || dims[1] > 4096 || dims[2] > 31 || dims[3] > 31)
        fail<InvalidInput>("a convolution of it is of ", dims[0], " x ", dims[1], " x ", dims[2],
                           " x ", dims[3], " weights, beyond 4096 x 4096 x 31 x 31");
    if (node.inputs.size() < 3)
        return;
    const OnnxTensor* bias = find_weight(graph, node.inputs[2]);
    if (bias == nullptr || bias->dims != std::vector<std::int64_t>{dims[0]})
        fail<InvalidInput>("a convolution of it has not one bias for each channel");
}

void check_ends(const Graph& graph) {
    if (graph.inputs.size() != 1 || graph.outputs.size() != 1)
        fail<InvalidInput>("it has ", graph.inputs.size(), " inputs and ", graph.outputs.size(),
                           " outputs");
    if (graph.inputs[0] != "picture")
        fail<InvalidInput>("its input is called '", graph.inputs[0], "'");
    if (graph.outputs[0] != "field")
        fail<InvalidInput>("its output is called '", graph.outputs[0], "'");
    const auto& dims = graph.input_dims;
    if (dims.size() != 4 || dims[0] > 1 || (dims[1] != 3 && dims[1] != 0)) {
        std::string text;
        for (const std::int64_t dim : dims)
            text += (text.empty() ? "" : " x ") + std::to_string(dim);
        fail<InvalidInput>("its input is of ", text.empty() ? "unknown size" : text);
    }
}

// Whatever is read was made before, and only once: no rings, no two things of one name.
void check_order(const Graph& graph) {
    std::set<std::string> made = {graph.inputs[0]};
    const auto make = [&](const std::string& name) {
        if (name.empty() || !made.insert(name).second)
            fail<InvalidInput>("it makes the value '", name, "' twice or without a name");
    };
    for (const OnnxTensor& tensor : graph.weights)
        make(tensor.name);
    for (const Node& node : graph.nodes) {
        for (const std::string& name : node.inputs)
            if (!name.empty() && made.count(name) == 0)
                fail<InvalidInput>("it uses the value '", name, "' before it is made");
        if (node.outputs.size() != 1)
            fail<InvalidInput>("an operator of it has ", node.outputs.size(), " results, not one");
        make(node.outputs[0]);
        if (node.type == "Conv")
            check_convolution(graph, node);
        else if (node.inputs.empty() && node.type != "Constant")
            fail<InvalidInput>("its operator '", node.type, "' has no input");
    }
    if (made.count(graph.outputs[0]) == 0)
        fail<InvalidInput>("it never makes its output");
}

std::string written_value(const std::string& name, std::initializer_list<unsigned> dims) {
    std::string shape;
    for (const unsigned dim : dims) {
        std::string one;
        put_varint(one, 1, dim);
        put_bytes(shape, 1, one);
    }
    std::string tensor, type, out;
    put_varint(tensor, 1, static_cast<std::uint64_t>(kOnnxFloat));
    put_bytes(tensor, 2, shape);
    put_bytes(type, 1, tensor);
    put_bytes(out, 1, name);
    put_bytes(out, 2, type);
    return out;
}

std::string written(const Node& node) {
    std::string out;
    for (const std::string& name : node.inputs)
        put_bytes(out, 1, name);
    for (const std::string& name : node.outputs)
        put_bytes(out, 2, name);
    put_bytes(out, 4, node.type);
    for (const std::string& attribute : node.attributes)
        put_bytes(out, 5, attribute);
    return out;
}

std::string written(const Graph& graph) {
    std::string out;
    for (const Node& node : graph.nodes)
        put_bytes(out, 1, written(node));
    put_bytes(out, 2, "outlines");
    for (const OnnxTensor& tensor : graph.weights)
        put_bytes(out, 5, written(tensor));
    put_bytes(out, 11, written_value(graph.inputs[0], {1, 3, 512, 512}));
    put_bytes(out, 12, written_value(graph.outputs[0], {}));
    return out;
}

std::string copied_opset(std::string_view message) {
    std::uint64_t version = 0;
    for (const WireField& field : wire_fields(message)) {
        if (field.number == 1 && !text_of(field).empty() && text_of(field) != "ai.onnx")
            fail<InvalidInput>("it needs the foreign operators '", text_of(field), "'");
        if (field.number == 2)
            version = field.value;
    }
    if (version < 7 || version > 20)
        fail<InvalidInput>("it is of operator set ", version, ", not of 7 to 20");
    std::string out;
    put_varint(out, 2, version);
    return out;
}

}  // namespace

std::string checked_network(std::string_view onnx) {
    std::optional<Graph> graph;
    std::string opset;
    for (const WireField& field : wire_fields(onnx)) {
        if (field.number == 8)
            opset = copied_opset(message_of(field));
        if (field.number != 7)
            continue;
        if (graph)
            fail<InvalidInput>("it holds two networks");
        graph = read_graph(message_of(field));
    }
    if (!graph || opset.empty())
        fail<InvalidInput>("it holds no network");
    check_ends(*graph);
    check_order(*graph);
    std::string out;
    put_varint(out, 1, 6);  // IR version
    put_bytes(out, 7, written(*graph));
    put_bytes(out, 8, opset);
    return out;
}

}  // namespace scree::vision
