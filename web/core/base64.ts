/** What an answer has as base64, as bytes. */
export function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}

/** The same, to be read as a frame. */
export function viewOf(base64: string): DataView<ArrayBuffer> {
  return new DataView(bytesOf(base64).buffer);
}
