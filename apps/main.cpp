#include <iostream>

int main() {
    std::cout << "scree 0.1.0\n";
    return 0;
}
