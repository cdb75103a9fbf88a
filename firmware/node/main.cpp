// What a board runs.
#include "firmware/board.hpp"
#include "firmware/node/firmware.hpp"

using vagus::firmware::the_firmware;

void vagus::board::on_byte(uint8_t byte) {
    vagus::firmware::receive_byte(the_firmware.receiver, byte);
}

bool vagus::board::next_byte(uint8_t& byte) {
    return vagus::firmware::take_byte(the_firmware.sender, byte);
}

int main() {
    vagus::firmware::start(the_firmware);
    for (;;) {
        vagus::board::alive();
        if (!vagus::firmware::turn(the_firmware)) vagus::board::sleep();
    }
}
