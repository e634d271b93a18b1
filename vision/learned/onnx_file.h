#pragma once

#include <string>
#include <string_view>

namespace scree::vision {

/// The same network as in an ONNX file, written anew from those parts of it that were understood
/// and checked, so that an importer may be given it whatever the file was. Weights of half
/// precision, which OpenCV 4.6 does not read, are widened to single.
///
/// Kept are operators (Conv, Relu, LeakyRelu, Sigmoid, Clip, MaxPool, AveragePool, Resize,
/// Upsample, Concat, Add, Mul, BatchNormalization, Constant, Identity), their attributes and
/// weights; names of nodes, shapes between them and remarks are dropped. The input is declared as 1
/// x 3 x 512 x 512.
///
/// @post  Every value an operator reads is made before it and once; every weight is finite; no
///        attribute is a network or an integer beyond 65536.
/// @throw InvalidInput  says what is wrong as a clause about "it", without the file's name.
std::string checked_network(std::string_view onnx);

}  // namespace scree::vision
