// What the connection needs of the world: a socket, a clock, chance. Tests hand in their own.

export interface Socket {
  send(text: string): void;
  close(): void;
}

export interface SocketEvents {
  open(): void;
  text(message: string): void;
  bytes(message: ArrayBuffer): void;
  closed(): void;
}

export interface World {
  connect(events: SocketEvents): Socket;
  /** Returns a function that calls it off. */
  later(milliseconds: number, act: () => void): () => void;
  /** Calls before the next frame is painted; not while the page is hidden. */
  frame(act: () => void): void;
  /** 0 to 1. */
  chance(): number;
  /** An HTTP request without a body; rejects unless the server has accepted it. */
  post(path: string, token: string): Promise<void>;
}

export function browserWorld(address: string): World {
  return {
    connect(events) {
      const socket = new WebSocket(address, 'vagus-1');
      socket.binaryType = 'arraybuffer';
      socket.onopen = () => events.open();
      socket.onclose = () => events.closed();
      socket.onmessage = (message: MessageEvent<string | ArrayBuffer>) =>
        typeof message.data === 'string' ? events.text(message.data) : events.bytes(message.data);
      return socket;
    },
    later(milliseconds, act) {
      const timer = setTimeout(act, milliseconds);
      return () => clearTimeout(timer);
    },
    frame: (act) => void requestAnimationFrame(act),
    chance: Math.random,
    async post(path, token) {
      const headers = { Authorization: `Bearer ${token}` };
      const answer = await fetch(path, { method: 'POST', headers, keepalive: true });
      if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
    },
  };
}
