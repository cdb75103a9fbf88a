/** The words of the picture of a camera, loaded with it. */
export const cameraWords = {
  sees: (robot: string) => `What the camera of ${robot} sees`,
  then: (robot: string, t: string) => `${robot} at ${t} s`,
  none: (robot: string) => `No picture of ${robot} was kept of this instant.`,
};
